#include "export/tolerance_frontier.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/analyze.hpp"
#include "results/scratch_folder.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// Who runs from a wall that stands at 1 + y: the delay is floor((x - 1 - y) / 2), y stays what it is.
class ToleranceFrontier : public testing::Test {
 protected:
  ToleranceFrontier() {
    ThreadTeam team(1);
    const ProblemSpec spec = read_spec(R"({"coordreq": 1, "name": "wall",
"states": [{"name": "x", "lower": 0, "upper": 9, "step": 1, "outside": "saturate"},
           {"name": "y", "lower": 0, "upper": 2, "step": 1, "outside": "saturate"}],
"inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [-1, 0, 1]}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u + v", "y": "y"}},
"safe": "x >= 1 + y", "abstraction": {"cells": "half_open", "safe": "center"}})",
                                       "test");
    static_cast<void>(analyze(spec, {.output = folder_ / "wall.h5"}, team));
    results_.emplace(folder_ / "wall.h5");
  }

  using Corners = std::vector<FrontierCorner>;
  using Axis = ToleranceQuestion::Axis;
  [[nodiscard]] Corners corners(std::int64_t steps, std::vector<Axis> axes,
                                std::vector<TableSelection::Slice> given = {}) const {
    return tolerance_frontier(
        *results_, {.partition = 0, .steps = steps, .axes = std::move(axes), .given = std::move(given)});
  }

 private:
  sample::ScratchFolder folder_;

 protected:
  std::optional<ResultsReader> results_;
};

TEST_F(ToleranceFrontier, OfOneStateIsWhereItBegins) {
  EXPECT_EQ(corners(2, {{0, true}}, {{1, 0}}), (Corners{{5}}));
  EXPECT_EQ(corners(2, {{0, true}}, {{1, 1}}), (Corners{{6}}));
  EXPECT_EQ(corners(4, {{0, true}}, {{1, 0}}), (Corners{{9}}));
}

TEST_F(ToleranceFrontier, OfStatesThatAreNotGivenTheWorstCounts) {
  EXPECT_EQ(corners(2, {{0, true}}), (Corners{{7}}));
}

TEST_F(ToleranceFrontier, IsNowhereWhereTheBestValueIsNotEnough) {
  EXPECT_EQ(corners(5, {{0, true}}, {{1, 0}}), Corners{});
  EXPECT_EQ(corners(1, {{0, false}}, {{1, 0}}), Corners{});
}

TEST_F(ToleranceFrontier, MayBeEverywhere) {
  EXPECT_EQ(corners(2, {{1, true}}, {{0, 9}}), (Corners{{0}}));
  EXPECT_EQ(corners(2, {{1, false}}, {{0, 9}}), (Corners{{2}}));
}

TEST_F(ToleranceFrontier, OfTwoStatesHasACornerForEachStep) {
  EXPECT_EQ(corners(2, {{0, true}, {1, false}}), (Corners{{5, 0}, {6, 1}, {7, 2}}));
  EXPECT_EQ(corners(2, {{1, false}, {0, true}}), (Corners{{2, 7}, {1, 6}, {0, 5}}));
  EXPECT_EQ(corners(2, {{0, true}, {1, true}}), (Corners{{7, 0}}));
}

}  // namespace
}  // namespace coordreq
