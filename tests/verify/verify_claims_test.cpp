#include <gtest/gtest.h>

#include <algorithm>

#include "answers/step_codes.hpp"
#include "support/analysed_file.hpp"

namespace coordreq {
namespace {

/// Two states that agents push along; the load of configs/load.json in small: an enclosure, no exact hull.
const std::string kFriction = R"json({"coordreq": 1, "name": "friction",
"states": [{"name": "v", "lower": -1, "upper": 1, "step": 0.25, "outside": "saturate"},
           {"name": "p", "lower": -2, "upper": 2, "step": 0.25}],
"inputs": [{"name": "left", "values": [-1, 0, 1]}, {"name": "right", "values": [-1, 0, 1]}],
"agents": [{"name": "a", "inputs": ["left"]}, {"name": "b", "inputs": ["right"]}],
"dynamics": {"time": "continuous", "period": 0.25, "equations": {"v": "left + right - 0.5*v", "p": "v"}},
"safe": "abs(p) <= 1.5", "abstraction": {"cells": "half_open"}})json";

bool has_wrong(const Verification& result, const std::string& check) {
  for (const Finding& finding : result.findings) {
    if (finding.check == check) return finding.wrong > 0;
  }
  return false;
}

TEST(VerifyClaims, EnclosuresHoldWithAndWithoutTheStoredAbstraction) {
  ThreadTeam team(2);
  const Verification computed = verify_file(analysed_file(kFriction, team), {}, team);
  EXPECT_EQ(complaints(computed), "");
  EXPECT_EQ(computed.basis, PostBasis::computed);
  const Verification stored = verify_file(analysed_file(storing_everything(kFriction), team), {}, team);
  EXPECT_EQ(complaints(stored), "");
  EXPECT_EQ(stored.basis, PostBasis::stored);
  EXPECT_TRUE(stored.borrowed.empty());
}

/// In the domain the state follows itself, elsewhere it does not.
TEST(VerifyClaims, AMapThatJumpsBeyondTheDomainHolds) {
  ThreadTeam team(2);
  const Verification found = verify_file(analysed_file(R"json({"coordreq": 1, "name": "jump",
"states": [{"name": "x", "lower": -6, "upper": -1, "count": 5, "outside": "periodic"}],
"inputs": [{"name": "u", "values": [-0.5, 0.25]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + 6*sign(x) + u"}}, "safe": "true"})json",
                                                       team),
                                         {}, team);
  EXPECT_EQ(complaints(found), "");
  EXPECT_EQ(found.confirmed, found.enclosed);
}

TEST(VerifyClaims, AStoredRangeThatLeavesOutACellIsFound) {
  ThreadTeam team(2);
  const ClaimedFile file = analysed_file(storing_everything(kFriction), team);
  for (std::size_t entry = 0; entry < file.claims.abstraction[0].entries.size(); entry += 7) {
    ClaimedFile changed = file;
    IndexRange& range = changed.claims.abstraction[0].entries[entry];
    if (range.first == range.last) continue;
    ++range.first;
    EXPECT_TRUE(has_wrong(verify_file(changed, {}, team), "abstraction v")) << entry;
  }
}

TEST(VerifyClaims, OfAnotherVersionLessSafetyIsLeftOpenAndMoreIsWrong) {
  ThreadTeam team(2);
  ClaimedFile file = analysed_file(kFriction, team);
  file.claims.same_version = false;
  std::vector<std::int32_t>& times = file.claims.fields.at("/collision_time").values.front();
  const auto late =
      std::find_if(times.begin(), times.end(), [](std::int32_t t) { return t >= 2 && t != kUnbounded; });
  ASSERT_NE(late, times.end());
  *late -= 1;
  const Verification less = verify_file(file, {}, team);
  EXPECT_FALSE(has_wrong(less, "collision time"));
  *late += 2;
  const Verification more = verify_file(file, {}, team);
  EXPECT_TRUE(has_wrong(more, "collision time"));
}

TEST(VerifyClaims, ASampleLooksAtSoManyCells) {
  ThreadTeam team(2);
  const ClaimedFile file = analysed_file(kFriction, team);
  const Verification result = verify_file(file, {.sample = 10}, team);
  EXPECT_EQ(result.cells_checked, 10);
  EXPECT_EQ(result.findings.back().checked, 10);
  EXPECT_TRUE(result.holds());
}

TEST(VerifyClaims, AGreaterKThanThereIsIsFound) {
  ThreadTeam team(2);
  ClaimedFile file = analysed_file(kFriction, team);
  auto& fields = file.claims.fields;
  std::vector<std::int32_t>& times = fields.at("/collision_time").values.front();
  const auto outside = std::find(times.begin(), times.end(), 1);
  ASSERT_NE(outside, times.end());
  const auto x = static_cast<std::size_t>(outside - times.begin());
  fields.at("/invariant").members.front()[x] = 1;
  fields.at("/invariant").cells.front() += 1;
  times[x] = kUnbounded;
  std::vector<std::int64_t>& sizes = fields.at("/layer_size").integers;
  const std::size_t partitions = fields.at("/delay").values.size();
  for (std::size_t p = 0; p < partitions; ++p) {
    fields.at("/delay").values[p][x] = 0;
    fields.at("/trigger").values[p][x] = 0;
    sizes[p * (sizes.size() / partitions)] += 1;
  }
  EXPECT_TRUE(has_wrong(verify_file(file, {}, team), "K"));
}

TEST(VerifyClaims, ASmallerKThanThereIsIsFoundThoughItIsSafe) {
  ThreadTeam team(2);
  ClaimedFile file = analysed_file(kFriction, team);
  // Nobody in K at all: safe, but by far not the greatest.
  auto& fields = file.claims.fields;
  std::vector<std::uint8_t>& invariant = fields.at("/invariant").members.front();
  std::fill(invariant.begin(), invariant.end(), 0);
  fields.at("/invariant").cells = {0};
  for (std::int32_t& time : fields.at("/collision_time").values.front()) time = time == kUnbounded ? 1 : time;
  for (std::vector<std::int32_t>& delays : fields.at("/delay").values) {
    for (std::int32_t& delay : delays) delay = std::min(delay, -1);
  }
  fields.at("/trigger").values = fields.at("/delay").values;
  fields.at("/fixed_point_index").integers.assign(fields.at("/delay").values.size(), 0);
  fields.at("/layer_size").integers.assign(fields.at("/delay").values.size(), 0);
  EXPECT_TRUE(has_wrong(verify_file(file, {}, team), "collision time"));
}

std::string between_samples(std::string text) {
  const std::string cells = R"("cells": "half_open")";
  return text.replace(text.find(cells), cells.size(), cells + R"(, "between_samples": true)");
}

TEST(VerifyClaims, EnclosuresOfTheWayBetweenTheSamplesHold) {
  ThreadTeam team(2);
  const Verification result = verify_file(analysed_file(between_samples(kFriction), team), {}, team);
  EXPECT_EQ(complaints(result), "");
  EXPECT_EQ(result.tubes, PostBasis::computed);
  EXPECT_TRUE(result.borrowed.empty());
  for (const Finding& finding : result.findings) EXPECT_EQ(finding.unproven, 0) << finding.check;
}

/// A fast vehicle and a thin obstacle: at the samples it can jump across.
std::string jumper(const std::string& between) {
  return R"json({"coordreq": 1, "name": "jumper",
"states": [{"name": "x", "lower": 0, "upper": 9, "step": 1, "outside": {"below": "unsafe", "above": "safe"}}],
"inputs": [{"name": "u", "values": [1, 4]}, {"name": "v", "values": [0]}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "continuous", "period": 1, "equations": {"x": "u + v"}},
"safe": "x <= 3.5 or x >= 5.5", "abstraction": {"cells": "half_open", "between_samples": )json" +
         between + "}}";
}

TEST(VerifyClaims, AResultThatOnlyHoldsAtTheSamplesIsFoundBetweenThem) {
  ThreadTeam team(2);
  const ClaimedFile with = analysed_file(jumper("true"), team);
  const Verification right = verify_file(with, {}, team);
  EXPECT_EQ(complaints(right), "");
  EXPECT_EQ(right.tubes, PostBasis::exact);
  ClaimedFile without = analysed_file(jumper("false"), team);
  EXPECT_TRUE(verify_file(without, {}, team).holds());
  without.spec = with.spec;
  const Verification wrong = verify_file(without, {}, team);
  EXPECT_TRUE(has_wrong(wrong, "K"));
}

TEST(VerifyClaims, AResultThatIsTooCautiousBetweenTheSamplesIsFoundToo) {
  ThreadTeam team(2);
  ClaimedFile with = analysed_file(jumper("true"), team);
  with.spec = analysed_file(jumper("false"), team).spec;
  EXPECT_TRUE(has_wrong(verify_file(with, {}, team), "collision time"));
}

}  // namespace
}  // namespace coordreq
