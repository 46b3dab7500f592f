#include "results/compare_results.hpp"
#include "answers/step_codes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "cell/analyzed_file.hpp"
#include "results/scratch_folder.hpp"
#include "spec/problem_spec.hpp"
#include "spec/set_value.hpp"
#include "support/random_problem.hpp"

namespace coordreq {
namespace {

/// Two agents, each on a line of five cells. @param rest of the spec, beginning with a comma
std::string spec_text(const std::string& safe, const std::string& rest = "") {
  return R"({"coordreq": 1, "name": "small",
    "states": [{"name": "x", "lower": 0, "upper": 4, "step": 1}, {"name": "y", "lower": 0, "upper": 4, "step": 1}],
    "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [-1, 0, 1]}],
    "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
    "dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u", "y": "y + v"}},
    "abstraction": {"cells": "half_open", "safe": "center"}, "safe": ")" +
         safe + "\"" + rest + "}";
}

/// Results of specs in a folder of their own.
class CompareResults : public testing::Test {
 protected:
  /// Path of the results of a spec.
  std::string file(const std::string& name, const std::string& text) {
    analyze_into(folder_ / name, text, "", team_);
    return folder_ / name;
  }

  ResultsComparison compare(const std::string& before, const std::string& after,
                            const CompareOptions& options = {}) {
    const ResultsReader old(before);
    const ResultsReader now(after);
    return compare_results(old, now, options);
  }

  std::string error_of(const std::string& before, const std::string& after) {
    try {
      static_cast<void>(compare(before, after));
    } catch (const ResultsError& error) {
      std::string what = error.what();
      for (std::size_t at = what.find(folder_ / ""); at != std::string::npos; at = what.find(folder_ / ""))
        what.erase(at, (folder_ / "").size());
      return what;
    }
    return "none";
  }

  ThreadTeam team_{1};
  sample::ScratchFolder folder_;
};

TEST_F(CompareResults, AFileIsNotWorseThanItself) {
  const std::string path = file("a.h5", spec_text("x + y <= 6"));
  const ResultsComparison comparison = compare(path, path);
  EXPECT_FALSE(comparison.is_worse());
  ASSERT_EQ(comparison.partitions.size(), 1U);
  EXPECT_EQ(comparison.values[0].lost, 0);
  EXPECT_EQ(comparison.values[0].gained, 0);
  EXPECT_EQ(comparison.sets.at(0).before, 22);
  EXPECT_EQ(comparison.sets.at(1).joined, 0);
}

TEST_F(CompareResults, UnboundedIsMoreThanAnyNumberAndNothingLessThanNone) {
  // With "x <= 9" everything is safe for ever; with "x + y <= 6" nothing is, and a corner is not safe at all.
  const std::string good = file("good.h5", spec_text("x <= 9"));
  const std::string bad = file("bad.h5", spec_text("x + y <= 6"));
  const ResultsComparison lost = compare(good, bad, {.worst = 4});
  ASSERT_EQ(lost.values.size(), 1U);
  const ValueComparison& partition = lost.values[0];
  EXPECT_EQ(partition.lost, 25);
  EXPECT_EQ(partition.left, 3);
  EXPECT_EQ(partition.from_forever, 22);
  ASSERT_EQ(partition.worst.size(), 4U);
  EXPECT_EQ(partition.worst[0].cell, 19);
  EXPECT_EQ(partition.worst[1].cell, 23);
  EXPECT_EQ(partition.worst[2].cell, 24);
  EXPECT_EQ(partition.worst[3].after, 0);
  EXPECT_EQ(compare(good, bad, {.tolerance = 1'000'000}).values[0].lost, 25);

  const ResultsComparison gained = compare(bad, good);
  EXPECT_FALSE(gained.is_worse());
  EXPECT_EQ(gained.values[0].gained, 25);
  EXPECT_TRUE(gained.values[0].worst.empty());
}

TEST_F(CompareResults, TheLastDelayBeforeALimitCountsAndIsMarked) {
  const std::string whole = file("whole.h5", spec_text("x + y <= 6"));
  const std::string cut = file("cut.h5", spec_text("x + y <= 6", R"(, "coordination": {"max_delay": 2})"));
  const ResultsComparison comparison = compare(whole, cut);
  EXPECT_EQ(comparison.values[0].lost, 1);  // of the only cell that tolerates 3
  EXPECT_EQ(comparison.values[0].cut_off, 1);
  EXPECT_EQ(comparison.values[0].worst[0].before, 3);
  EXPECT_EQ(comparison.values[0].worst[0].after, 2);
  EXPECT_EQ(compare(cut, whole).values[0].gained, 1);
}

TEST_F(CompareResults, PartitionsAreTheSameByNameOrClasses) {
  const auto with = [](const std::string& partitions) {
    return spec_text("x + y <= 6", R"(, "coordination": {"partitions": [)" + partitions + "]}");
  };
  const std::string a =
      file("a.h5", with(R"({"name": "all", "classes": [["a", "b"]]}, {"name": "apart", "classes": []})"));
  const std::string b = file("b.h5", spec_text("x + y <= 6"));
  const ResultsComparison comparison = compare(a, b);
  ASSERT_EQ(comparison.partitions.size(), 1U);
  EXPECT_EQ(comparison.partitions.at(0).before, 1U);
  EXPECT_EQ(comparison.partitions.at(0).after, 0U);
  EXPECT_EQ(comparison.only_before, std::vector<std::size_t>{0});
  EXPECT_TRUE(comparison.only_after.empty());
  const std::string c = file("c.h5", with(R"({"name": "together", "classes": [["a", "b"]]})"));
  EXPECT_EQ(error_of(b, c), "no partition of b.h5 is in it (c.h5)");
}

TEST_F(CompareResults, VerdictsThatChangeAreTold) {
  const std::string region = "x >= 1.9 and x <= 2.1 and y >= 1.9 and y <= 2.1";
  const auto with = [&region](const std::string& steps, const std::string& other) {
    return spec_text("x + y <= 6", R"(, "requirements": [{"name": "middle", "where": ")" + region +
                                       R"(", "min_delay": )" + steps + R"(}, {"name": ")" + other +
                                       R"(", "where": ")" + region + R"(", "invariant": true}])");
  };
  const std::string a = file("a.h5", with("1", "first"));
  const std::string b = file("b.h5", with("2", "second"));
  const ResultsComparison comparison = compare(a, b);
  ASSERT_EQ(comparison.verdicts.size(), 1U);
  EXPECT_EQ(comparison.verdicts[0].name, "middle");
  EXPECT_FALSE(comparison.verdicts[0].holds_after);
  EXPECT_EQ(comparison.requirements_only_before, std::vector<std::string>{"first"});
  EXPECT_EQ(comparison.requirements_only_after, std::vector<std::string>{"second"});
  EXPECT_TRUE(comparison.is_worse());
  EXPECT_FALSE(compare(b, a).is_worse());
}

TEST_F(CompareResults, GridsMustBeTheSame) {
  const std::string text = spec_text("x + y <= 6");
  const std::string a = file("a.h5", text);
  const auto changed = [&](const std::string& path, const std::string& value) {
    return error_of(a, file("b.h5", with_setting(text, "test", {path, value})));
  };
  EXPECT_EQ(changed("states.1.upper", "5"),
            "expected the grid of y as in a.h5: 5 points, found 6 points (b.h5)");
  EXPECT_EQ(changed("states.0", R"({"name": "x", "lower": 1, "upper": 5, "step": 1})"),
            "expected the first grid point of x as in a.h5: 0, found 1 (b.h5)");
  EXPECT_EQ(changed("states.0", R"({"name": "x", "lower": 0, "upper": 8, "step": 2})"),
            "expected the step of x as in a.h5: 1, found 2 (b.h5)");
  EXPECT_EQ(changed("states.0.unit", "km"), "expected the unit of x as in a.h5: none, found 'km' (b.h5)");
  EXPECT_EQ(changed("dynamics.period", "0.5"), "expected the period as in a.h5: 1, found 0.5 (b.h5)");
}

/// Steps that a code of a delay stands for, with what is not in K below all of them.
double steps(std::int32_t delay) {
  return delay == kUnbounded ? std::numeric_limits<double>::infinity() : std::max(delay, -1);
}

/// What is counted, added up from the whole arrays.
void expect_sums(const ResultsReader& before, const ResultsReader& after, const ValueComparison& found,
                 std::int64_t tolerance) {
  const CellBlock all = all_cells(before.grid());
  const std::vector<std::int32_t> old = before.values("/delay", found.entry->before, all),
                                  now = after.values("/delay", found.entry->after, all);
  ValueComparison expected;
  for (std::size_t i = 0; i < old.size(); ++i) {
    const double a = steps(old[i]), b = steps(now[i]);
    const bool only_steps = b >= 0 && std::isfinite(a);
    const bool tolerated = only_steps && a > b && a - b <= static_cast<double>(tolerance);
    expected.lost += a > b && !tolerated ? 1 : 0;
    expected.tolerated += tolerated ? 1 : 0;
    expected.left += a >= 0 && b < 0 ? 1 : 0;
    expected.from_forever += std::isinf(a) && b >= 0 && std::isfinite(b) ? 1 : 0;
    expected.gained += a < b ? 1 : 0;
  }
  RC_ASSERT(found.lost == expected.lost);
  RC_ASSERT(found.tolerated == expected.tolerated);
  RC_ASSERT(found.left == expected.left);
  RC_ASSERT(found.from_forever == expected.from_forever);
  RC_ASSERT(found.gained == expected.gained);
  RC_ASSERT(static_cast<std::int64_t>(found.worst.size()) == std::min<std::int64_t>(3, found.lost));
}

TEST_F(CompareResults, AddsUpWhatTheArraysSay) {
  EXPECT_TRUE(rc::check("sums of random problems, one of them changed", [this] {
    const std::string text = draw_problem();
    const std::string unsafe = "(" + read_spec(text, "test").states[0].name + " - " +
                               std::to_string(*rc::gen::inRange(-3, 4)) + ")^2 > 1";
    std::string other = with_setting(text, "test", {"safe", unsafe});
    if (*rc::gen::arbitrary<bool>()) {
      const std::string limit = std::to_string(*rc::gen::inRange(0, 4));
      other = with_setting(other, "test", {"coordination.max_delay", limit});
    }
    const bool swapped = *rc::gen::arbitrary<bool>();
    const ResultsReader before(file("a.h5", swapped ? other : text));
    const ResultsReader after(file("b.h5", swapped ? text : other));
    const auto tolerance = *rc::gen::inRange<std::int64_t>(0, 3);
    const ResultsComparison comparison = compare_results(before, after, {.tolerance = tolerance, .worst = 3});
    RC_ASSERT(comparison.values.size() == before.partitions().size());
    RC_ASSERT(comparison.sets.at(0).before == static_cast<std::int64_t>(before.attributes().safe_cells));
    RC_ASSERT(comparison.sets.at(1).after == static_cast<std::int64_t>(after.attributes().invariant_cells));
    for (const SetComparison& set : comparison.sets)
      RC_ASSERT(set.before - set.left + set.joined == set.after);
    for (const ValueComparison& partition : comparison.values)
      expect_sums(before, after, partition, tolerance);
  }));
}

}  // namespace
}  // namespace coordreq
