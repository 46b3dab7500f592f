#include "reach/tables.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <memory>
#include <set>

#include "base/error.hpp"
#include "reach/build_abstraction.hpp"
#include "reach/point_dynamics.hpp"
#include "support/read_system.hpp"

namespace coordreq {
namespace {

struct Parts {
  std::string update;
  std::string m = R"("lower": 0, "upper": 2, "step": 1)";
  std::string x = R"("lower": -2, "upper": 2)";
  std::string more;  // keys of the spec
};

/// A mode m that a continuous state x switches.
SystemSpec mode_of(const Parts& parts) {
  return read_system(R"({"coordreq": 1, "name": "t", "states": [
{"name": "m", "discrete": true, )" +
                         parts.m + R"(}, {"name": "x", "step": 1, )" + parts.x + R"(}],
"inputs": [{"name": "u", "values": [0, 1]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "continuous", "period": 1, "equations": {"x": "u"}, "updates": {"m": ")" +
                         parts.update + R"("}},)" + parts.more + R"("safe": "true"})",
                     "test");
}

Abstraction built(const SystemSpec& spec) {
  ThreadTeam team(2);
  return build_abstraction(spec, team);
}

/// What m can be next.
IndexRange next(const Abstraction& a, std::int64_t m, std::int64_t x, std::int64_t u) {
  return a.raw(0, m * a.grid.stride(0) + x, u);
}

std::string error_of(const SystemSpec& spec) {
  try {
    static_cast<void>(built(spec));
  } catch (const SpecError& error) {
    return error.what();
  }
  return "no error";
}

TEST(UpdateTable, BothBranchesCountWhereADisturbanceDecides) {
  const auto with = [](const std::string& equation) {
    return read_system(R"({"coordreq": 1, "name": "t",
"states": [{"name": "m", "discrete": true, "lower": 0, "upper": 3, "step": 1}],
"inputs": [{"name": "u", "values": [0, 1]}], "agents": [{"name": "a", "inputs": ["u"]}],
"disturbances": [{"name": "v", "lower": 2, "upper": 3}, {"name": "w", "lower": 0, "upper": 1}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"m": ")" +
                           equation + R"("}}, "safe": "true"})",
                       "test");
  };
  // A fault that may happen; one that cannot, as v says; one that has happened.
  const auto from = [](const Abstraction& all, std::int64_t m, std::int64_t u) { return all.raw(0, m, u); };
  EXPECT_NE(error_of(with("m + w")), "no error");
  const Abstraction b = built(with("if(m == 0, 1, if(m == 1, if(w > 1/2, 2 + u, 1), if(v > 1, 3, 0)))"));
  EXPECT_EQ(from(b, 0, 0), (IndexRange{1, 1}));
  EXPECT_EQ(from(b, 1, 0), (IndexRange{1, 2}));
  EXPECT_EQ(from(b, 1, 1), (IndexRange{1, 3}));
  EXPECT_EQ(from(b, 2, 0), (IndexRange{3, 3}));
  EXPECT_TRUE(b.exact);
  EXPECT_TRUE(built(with("if(w > 1 or v < 2, 0, m)")).exact);
}

TEST(UpdateTable, BothBranchesCountWhereTheCellLeavesTheConditionOpen) {
  const Abstraction a = built(mode_of({"if(x >= 0.2, 2, 0)"}));
  EXPECT_EQ(next(a, 1, 1, 0), (IndexRange{0, 0}));
  EXPECT_EQ(next(a, 1, 2, 0), (IndexRange{0, 2}));  // [-0.5, 0.5]: the hull, 1 included
  EXPECT_EQ(next(a, 1, 3, 0), (IndexRange{2, 2}));
  EXPECT_TRUE(a.exact);
}

TEST(UpdateTable, TheStateMovesOnlyAtSamples) {
  const SystemSpec spec = read_system(R"({"coordreq": 1, "name": "t", "states": [
{"name": "x", "lower": -3, "upper": 3, "step": 1}, {"name": "m", "lower": -1, "upper": 1, "step": 1, "discrete": true}],
"inputs": [{"name": "u", "values": [0]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "continuous", "period": 1, "equations": {"x": "m"}, "updates": {"m": "-m"}},
"safe": "true", "abstraction": {"cells": "half_open"}})",
                                      "test");
  const Abstraction a = built(spec);
  EXPECT_EQ(a.raw(0, 3 * 3 + 2, 0), (IndexRange{4, 4}));  // x = 0, m = 1
  EXPECT_EQ(a.raw(1, 3 * 3 + 2, 0), (IndexRange{0, 0}));
}

TEST(UpdateTable, ConditionsBranchIndependently) {
  const Abstraction a = built(mode_of({"1 + if(x >= 0, 1, 0) - if(x >= 0, 1, 0)"}));
  EXPECT_EQ(next(a, 0, 2, 0), (IndexRange{0, 2}));
  EXPECT_EQ(next(a, 0, 3, 0), (IndexRange{1, 1}));
}

TEST(UpdateTable, MeasurementErrorsWidenTheCell) {
  const Parts exact{.update = "if(x >= 0.7, 1, 0)"};
  Parts measured = exact;
  measured.x += R"(, "measurement_error": 0.25)";
  EXPECT_EQ(next(built(mode_of(exact)), 0, 2, 0), (IndexRange{0, 0}));
  EXPECT_EQ(next(built(mode_of(measured)), 0, 2, 0), (IndexRange{0, 1}));
}

TEST(UpdateTable, OnARingTheHullIsThatOfTheUnwrappedLine) {
  const Abstraction a = built(mode_of({.update = "if(x >= 0, m + 1, m - 1)",
                                       .m = R"("lower": 0, "upper": 3, "count": 3, "outside": "periodic")"}));
  EXPECT_EQ(next(a, 0, 2, 0), (IndexRange{-1, 1}));
}

TEST(UpdateTable, ABranchThatIsExcludedMayBeAnything) {
  EXPECT_EQ(error_of(mode_of({"if(x > 9, 1/0, 1)"})), "no error");
  EXPECT_EQ(error_of(mode_of({"if(x >= 0.2, m/2, 0)"})),
            "the next value of the discrete state 'm' can be 0.5 at m = 1, x = 0, expected 0 + k * 1 with an "
            "integer k (/dynamics/updates/m)");
  EXPECT_EQ(
      error_of(mode_of({"if(x > 9, 0, sqrt(m))"})),
      "the next value of the discrete state 'm' can be a number that is not known exactly at m = 2, x = -2, "
      "expected 0 + k * 1 with an integer k (/dynamics/updates/m)");
}

TEST(UpdateTable, BetweenTheSamplesTheValueIsKept) {
  const Abstraction a = built(
      mode_of({.update = "if(x >= 0.2, 2, 0)", .more = R"("abstraction": {"between_samples": true},)"}));
  EXPECT_EQ(a.raw_tube(0, 1 * 5 + 2, 0), (IndexRange{1, 1}));
}

TEST(UpdateTable, DiscreteStatesInDiscreteTimeMayAskTheSame) {
  const SystemSpec spec = read_system(R"spec({"coordreq": 1, "name": "t", "states": [
{"name": "m", "lower": 0, "upper": 2, "step": 1, "discrete": true}, {"name": "x", "lower": -2, "upper": 2, "step": 1}],
"inputs": [{"name": "u", "values": [0, 1]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u", "m": "if(x >= 0.2, 2, m)"}},
"safe": "true"})spec",
                                      "test");
  const Abstraction a = built(spec);
  EXPECT_EQ(next(a, 1, 2, 0), (IndexRange{1, 2}));
  EXPECT_EQ(next(a, 0, 2, 0), (IndexRange{0, 2}));
  EXPECT_TRUE(a.exact);
}

/// A random update as a tree, with its values over a cell straight from the definition.
struct Tree {
  enum class Kind { number, mode, input, sum, choice };
  Kind kind = Kind::number;
  int number = 0;  // or, of a choice, what x is compared with, in quarters
  std::unique_ptr<Tree> a, b;

  [[nodiscard]] std::string text() const {
    switch (kind) {
      case Kind::number:
        return std::to_string(number);
      case Kind::mode:
        return "m";
      case Kind::input:
        return "u";
      case Kind::sum:
        return "(" + a->text() + " + " + b->text() + ")";
      default:
        return "if(x >= " + std::to_string(number) + "/4, " + a->text() + ", " + b->text() + ")";
    }
  }
  [[nodiscard]] std::set<int> values(int m, int u, int low, int high) const {
    switch (kind) {
      case Kind::number:
        return {number};
      case Kind::mode:
        return {m};
      case Kind::input:
        return {u};
      case Kind::sum: {
        std::set<int> sums;
        for (const int p : a->values(m, u, low, high)) {
          for (const int q : b->values(m, u, low, high)) sums.insert(p + q);
        }
        return sums;
      }
      default: {
        std::set<int> all;
        if (high >= number) all.merge(a->values(m, u, low, high));
        if (low < number) all.merge(b->values(m, u, low, high));
        return all;
      }
    }
  }
};

std::unique_ptr<Tree> random_tree(int depth) {
  auto tree = std::make_unique<Tree>();
  tree->kind = static_cast<Tree::Kind>(*rc::gen::inRange(depth == 0 ? 0 : 1, depth == 0 ? 3 : 5));
  tree->number = *rc::gen::inRange(-6, 7);
  if (tree->kind != Tree::Kind::sum && tree->kind != Tree::Kind::choice) return tree;
  tree->a = random_tree(depth - 1);
  tree->b = random_tree(depth - 1);
  return tree;
}

RC_GTEST_PROP(UpdateTable, AgreesWithAllBranchesAndHoldsEveryMotion, ()) {
  const std::unique_ptr<Tree> tree = random_tree(3);
  const SystemSpec spec = mode_of({tree->text()});
  const Abstraction a = built(spec);
  PointDynamics dynamics(spec);
  for (int m = 0; m <= 2; ++m) {
    for (int x = -2; x <= 2; ++x) {
      for (int u = 0; u <= 1; ++u) {
        const std::set<int> values = tree->values(m, u, 4 * x - 2, 4 * x + 2);
        const IndexRange range = next(a, m, x + 2, u);
        RC_ASSERT(range.first == *values.begin());
        RC_ASSERT(range.last == *values.rbegin());
        for (int k = -2; k <= 2; ++k) {
          const std::optional<Rational> value = dynamics.next(0, {m, Rational(4 * x + k) / 4, u});
          RC_ASSERT(value && *value >= range.first && *value <= range.last);
        }
      }
    }
  }
}

}  // namespace
}  // namespace coordreq
