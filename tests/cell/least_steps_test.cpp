#include "cell/least_steps.hpp"
#include "answers/step_codes.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "answers/paths.hpp"
#include "base/error.hpp"
#include "cell/analyzed_file.hpp"
#include "results/scratch_folder.hpp"

namespace coordreq {
namespace {

// Two vehicles that may not be at the far corner together, with every kind of side.
const char* const kCornerSpec = R"({"coordreq": 1, "name": "corner", "states": [
    {"name": "x", "lower": 0, "upper": 4, "step": 1, "outside": {"below": "safe", "above": "unsafe"}},
    {"name": "y", "lower": 0, "upper": 4, "step": 1, "outside": "saturate"},
    {"name": "mode", "lower": 0, "upper": 1, "step": 1, "discrete": true}],
    "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [-1, 0, 1]}],
    "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
    "dynamics": {"time": "discrete", "period": 0.5, "equations": {"x": "x + u", "y": "y + v", "mode": "mode"}},
    "safe": "x + y <= 6", "abstraction": {"cells": "half_open", "safe": "center"}})";

class Pairs {
 public:
  Pairs() {
    ThreadTeam team(1);
    analyze_into(folder_ / "out.h5", kCornerSpec, "", team);
    results_.emplace(folder_ / "out.h5");
  }

  /// Of delays, which are steps over partitions like any others.
  [[nodiscard]] LeastSteps least(const std::string& text, std::optional<std::int32_t> at_least = {}) {
    std::istringstream stream(text);
    others_.clear();
    return least_steps(*results_, results_->field(paths::kDelay), 0, stream, "pairs", at_least,
                       [this](const std::vector<std::string>& names) { others_ = names; });
  }
  [[nodiscard]] std::string defect(const std::string& text) {
    try {
      static_cast<void>(least(text));
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  }
  [[nodiscard]] const std::vector<std::string>& others() const { return others_; }
  [[nodiscard]] std::int32_t delay(std::int64_t cell) const {
    return results_->values(paths::kDelay, 0, one_cell(results_->grid(), cell)).front();
  }

 private:
  sample::ScratchFolder folder_;
  std::optional<ResultsReader> results_;
  std::vector<std::string> others_;
};

TEST(LeastSteps, TheLeastOfAllPairsAndTheFirstOfEquals) {
  Pairs pairs;
  const LeastSteps found =
      pairs.least("pair,x,y,mode,t\nnorth,1,1,0,7\nsouth,3,2,1,7\neast,3,2,0,7\nwest,2,2,0,7\n", 2);
  EXPECT_EQ(found.pairs, 4);
  EXPECT_EQ(found.least, pairs.delay((3 * 5 + 2) * 2 + 1));
  EXPECT_EQ(found.pair, "south");
  EXPECT_EQ(found.below, 3);
  EXPECT_EQ(pairs.others(), std::vector<std::string>{"t"});
  EXPECT_EQ(pairs.least("x,y,mode\n1,1,0\n3,2,0\n").pair, "2");
  EXPECT_EQ(pairs.least("x,y,mode\n1,1,0\n3,2,0\n").below, std::nullopt);
  EXPECT_EQ(pairs.least(R"({"x": 1, "y": 1, "mode": 0, "pair": "one"})").pair, "one");
  EXPECT_EQ(pairs.least(R"({"x": 1, "y": 1, "mode": 0, "pair": 17})").pair, "17");
}

TEST(LeastSteps, BeyondTheDomainTheSidesSayWhatAPairHas) {
  Pairs pairs;
  EXPECT_EQ(pairs.least("x,y,mode\n9,1,0\n").least, -2);
  EXPECT_EQ(pairs.least("x,y,mode\n-9,1,0\n").least, kUnbounded);
  EXPECT_EQ(pairs.least("x,y,mode\n-9,99,0\n").least, kUnbounded);
  EXPECT_EQ(pairs.least("x,y,mode\n1,99,0\n").least, pairs.delay((1 * 5 + 4) * 2));
  EXPECT_EQ(pairs.least("x,y,mode\n1,-99,0\n").least, pairs.delay((1 * 5 + 0) * 2));
  EXPECT_EQ(pairs.least("x,y,mode\n4,4,0\n").least, -2);
  EXPECT_EQ(pairs.least("x,y,mode\n-9,1,0\n", 1000000).below, 0);
}

TEST(LeastSteps, SaysWhatIsWrong) {
  Pairs pairs;
  EXPECT_EQ(pairs.defect("x,y,mode\n1,1,0.5\n"),
            "mode = 0.5 is not a value of this discrete state (pairs, line 2)");
  EXPECT_EQ(pairs.defect("x,y,mode\n"),
            "no pairs, expected a line of column names and a line for each (pairs)");
  EXPECT_EQ(pairs.defect("x,mode\n1,0\n"), "no column for the state 'y' (pairs, line 1)");
}

}  // namespace
}  // namespace coordreq
