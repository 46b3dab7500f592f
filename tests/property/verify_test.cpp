// Results of random systems hold, and do not once a number in them is another one.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "answers/step_codes.hpp"
#include "spec/problem_spec.hpp"
#include "support/analysed_file.hpp"
#include "support/draw.hpp"
#include "support/random_goal.hpp"
#include "support/random_problem.hpp"
#include "support/random_sight.hpp"
#include "support/random_silence.hpp"

namespace coordreq {
namespace {

template <class T>
T& draw_one_of(std::vector<T>& values) {
  return values[static_cast<std::size_t>(draw(0, static_cast<int>(values.size()) - 1))];
}

TEST(Verify, ResultsOfRandomSystemsHold) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("what analyze writes holds", [&] {
    std::string text = draw(0, 1) == 0 ? draw_problem() : perhaps_with_goal(draw_problem());
    if (draw(0, 2) == 0) text = with_sight(text);
    if (draw(0, 2) == 0) text = with_silence(text);
    const ClaimedFile file = analysed_file(draw(0, 1) == 0 ? text : storing_everything(text), team);
    const Verification result = verify_file(file, {.budget_seconds = 0.1}, team);
    RC_LOG(complaints(result));
    RC_CLASSIFY(result.basis == PostBasis::exact, "exact");
    RC_ASSERT(result.holds());
  }));
}

TEST(Verify, LastingGoalsOfRandomSystemsHoldWholly) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("what analyze writes of goals to stay at and to return to holds", [&] {
    nlohmann::json spec = nlohmann::json::parse(draw_problem());
    spec["goal"] = {{"where", draw_goal(spec["states"])},
                    {"then", *rc::gen::element<std::string>("stay", "return")}};
    const ClaimedFile file = analysed_file(storing_everything(spec.dump()), team);
    const Verification result = verify_file(file, {.full = true}, team);
    RC_LOG(complaints(result));
    RC_ASSERT(result.holds());
  }));
}

TEST(Verify, ResultsThatAreSafeBetweenTheSamplesHold) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("what analyze writes with tubes holds", [&] {
    const std::string text = draw_problem(RandomTime::between_samples);
    const ClaimedFile file = analysed_file(draw(0, 1) == 0 ? text : storing_everything(text), team);
    const Verification result = verify_file(file, {.budget_seconds = 0.1}, team);
    RC_LOG(complaints(result));
    RC_CLASSIFY(result.tubes == PostBasis::exact, "exact");
    RC_ASSERT(result.holds());
  }));
}

/// Cells of the goal may leave it within K: their rows are not alike where only the goal around them is.
TEST(Verify, AConventionOnTheWayToAGoalHolds) {
  ThreadTeam team(2);
  const ClaimedFile file = analysed_file(R"json({"coordreq": 1, "name": "meet",
    "states": [{"name": "x0", "lower": 0, "upper": 9, "step": 1, "outside": {"below": "saturate", "above": "unsafe"}},
               {"name": "x1", "lower": 0, "upper": 8, "step": 1, "outside": {"below": "saturate", "above": "safe"}},
               {"name": "x2", "lower": 0, "upper": 7, "count": 7, "outside": "periodic"}],
    "inputs": [{"name": "u0", "values": [1, 0, -2]}, {"name": "u1", "lower": -1, "upper": 1, "step": 0.5},
               {"name": "u2", "lower": -1, "upper": 1, "step": 1}],
    "agents": [{"name": "a0", "inputs": ["u0"]}, {"name": "a1", "inputs": ["u1"]}, {"name": "a2", "inputs": ["u2"]}],
    "dynamics": {"time": "continuous", "period": 1, "equations": {"x0": "u0", "x1": "u1", "x2": "u2"}},
    "safe": "x0 + x1 >= 5 and x0 + x1 <= 13", "abstraction": {"cells": "half_open", "safe": "center"},
    "coordination": {"convention": true}, "goal": "x0 <= 5.5"})json",
                                         team);
  EXPECT_EQ(complaints(verify_file(file, {}, team)), "");
}

/// A solver that forgot the way between the samples.
TEST(Verify, AResultWithoutTubesIsFoundUnlessItIsTheSame) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("a result that holds at the samples only", [&] {
    std::string text = draw_problem(RandomTime::between_samples);
    const ClaimedFile right = analysed_file(text, team);
    const std::string asked = R"("between_samples": true)";
    text.replace(text.find(asked), asked.size(), R"("between_samples": false)");
    ClaimedFile wrong = analysed_file(text, team);
    wrong.spec = right.spec;
    bool same = true;
    for (const char* const path : {"/collision_time", "/delay"})
      same = same && wrong.claims.at(path).values == right.claims.at(path).values;
    RC_CLASSIFY(same, "same");
    RC_ASSERT(verify_file(wrong, {.budget_seconds = 0.1}, team).holds() == same);
  }));
}

/// Another partition or pair at one place, or another number of cells.
void corrupt_coalition(Claims& claims) {
  switch (draw(0, 3)) {
    case 0: {
      std::int32_t& chosen = draw_one_of(claims.fields.at("/coalition").values.front());
      chosen = chosen == 0 ? -3 : chosen - 1;
      return;
    }
    case 1:
      draw_one_of(draw_one_of(claims.fields.at("/critical_pair").members)) ^= 1U;
      return;
    case 2:
      draw_one_of(claims.fields.at("/coalition").cells) += 1;
      return;
    default:
      draw_one_of(claims.fields.at("/critical_pair").cells) += 1;
  }
}

TEST(Verify, CoalitionsOfManyAgentsHoldAndOneOtherIsFound) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("coalition maps", [&] {
    ClaimedFile file =
        analysed_file(draw_problem(RandomTime::any, RandomEdges::any, RandomAgents::many), team);
    const Verification result = verify_file(file, {.budget_seconds = 0.1}, team);
    RC_LOG(complaints(result));
    RC_ASSERT(result.holds());
    corrupt_coalition(file.claims);
    RC_ASSERT(!verify_file(file, {.budget_seconds = 0.1}, team).holds());
  }));
}

/// One of the fields, without scales, whose paths begin and end so.
std::string draw_path(const Claims& claims, const std::string& begin, const std::string& end) {
  std::vector<std::string> paths;
  for (const auto& [path, field] : claims.fields) {
    if (path.starts_with(begin) && path.ends_with(end) && !path.ends_with(":byte")) paths.push_back(path);
  }
  return draw_one_of(paths);
}

/// Another number that the file could also hold at one place. @returns false if there is no such place
bool corrupt(Claims& claims) {
  const auto values = [&claims](const char* path) -> std::vector<std::vector<std::int32_t>>& {
    return claims.fields.at(path).values;
  };
  const auto flip = [](std::vector<std::uint8_t>& bits) {
    draw_one_of(bits) ^= static_cast<std::uint8_t>(1U << draw(0, 7));
  };
  const std::int32_t step = draw(0, 1) == 0 ? 1 : -1;
  switch (draw(0, 9)) {
    case 0:
      draw_one_of(claims.fields.at("/safe").members.front()) ^= 1U;
      return true;
    case 1:
      draw_one_of(claims.fields.at("/invariant").members.front()) ^= 1U;
      return true;
    case 2: {
      std::int32_t& time = draw_one_of(values("/collision_time").front());
      time = time == kUnbounded ? 1 : time + 1;
      return true;
    }
    case 3: {
      std::int32_t& delay = draw_one_of(draw_one_of(values("/delay")));
      delay = delay == kUnbounded ? draw(0, 3) : std::max(delay + step, -2 + (delay == -2 ? 1 : 0));
      return true;
    }
    case 4: {
      std::int32_t& trigger = draw_one_of(draw_one_of(values("/trigger")));
      trigger = trigger == kUnbounded ? 0 : trigger + 1;
      return true;
    }
    case 5:
      draw_one_of(claims.fields.at("/fixed_point_index").integers) += 1;
      return true;
    case 6:
      draw_one_of(claims.fields.at("/layer_size").integers) += 1;
      return true;
    case 7:
      flip(claims.fields.at("/controller").bits);
      return true;
    case 8:
      flip(claims.fields.at(draw_path(claims, "/actions/", "")).bits);
      return true;
    default: {
      std::vector<std::int64_t>& cells = claims.fields.at(draw_path(claims, "/layers/", "/cell")).integers;
      if (cells.empty()) return false;
      std::int64_t& cell = draw_one_of(cells);
      cell = cell == 0 ? 1 : cell - 1;
      return true;
    }
  }
}

TEST(Verify, OneOtherNumberIsFound) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("a corrupted result does not hold", [&] {
    ClaimedFile file = analysed_file(storing_everything(draw_problem()), team);
    RC_PRE(corrupt(file.claims));
    RC_ASSERT(!verify_file(file, {.budget_seconds = 0.1}, team).holds());
  }));
}

/// A wrong solver is worse than a flipped bit: what it writes fits together. Here all delays of a layer and
/// everything that counts them are one too long.
TEST(Verify, ALayerThatIsTooLargeIsFoundThoughAllCountsAgree) {
  ThreadTeam team(2);
  const auto found = [&] {
    ClaimedFile file = analysed_file(draw_problem(), team);
    std::vector<std::int32_t>& delay = file.claims.fields.at("/delay").values.front();
    std::vector<std::int64_t>& sizes = file.claims.fields.at("/layer_size").integers;
    const std::size_t layers = sizes.size() / file.spec.coordination.partitions.size();
    const auto last = static_cast<int>(file.claims.at("/fixed_point_index").integers.front());
    RC_PRE(last >= 1);
    const std::int32_t layer = draw(0, last - 1);
    std::int64_t moved = 0;
    for (std::size_t x = 0; x < delay.size(); ++x) {
      if (delay[x] != layer) continue;
      delay[x] = kUnbounded;
      file.claims.fields.at("/trigger").values.front()[x] = kUnbounded;
      ++moved;
      break;
    }
    for (std::size_t k = static_cast<std::size_t>(layer) + 1; k < layers; ++k) sizes[k] += moved;
    RC_ASSERT(!verify_file(file, {.budget_seconds = 0.1}, team).holds());
  };
  EXPECT_TRUE(rc::check("one cell that claims to be unbounded", found));
}

}  // namespace
}  // namespace coordreq
