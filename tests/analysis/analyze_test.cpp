#include "analysis/analyze.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "results/scratch_folder.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// With all that only goes into a file.
ProblemSpec spec() {
  return read_spec(R"({"coordreq": 1, "name": "small",
    "states": [{"name": "x", "lower": 0, "upper": 4, "step": 1}, {"name": "y", "lower": 0, "upper": 4, "step": 1}],
    "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [-1, 0, 1]}],
    "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
    "dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u", "y": "y + v"}},
    "abstraction": {"cells": "half_open", "safe": "center"}, "safe": "x + y <= 6",
    "coordination": {"partitions": "all", "horizon": 2, "convention": true},
    "requirements": [{"name": "r", "where": "x <= 0.1 and x > 0 and y <= 0.1 and y > 0", "invariant": true}]})",
                   "test");
}

TEST(Analyze, SaysTheSameWithoutAResultsFile) {
  ThreadTeam team(1);
  const sample::ScratchFolder folder;
  AnalysisOptions options;
  std::vector<std::string> stages;
  options.progress = [&stages](const Progress& progress) {
    if (stages.empty() || stages.back() != progress.stage) stages.push_back(progress.stage);
  };
  const Json without = analyze(spec(), options, team);
  EXPECT_NE(stages.back(), "writing");
  EXPECT_TRUE(without["output"].is_null());

  options.output = folder / "results.h5";
  const Json with = analyze(spec(), options, team);
  EXPECT_EQ(stages.back(), "writing");
  EXPECT_TRUE(std::filesystem::exists(options.output));
  EXPECT_EQ(with["output"], options.output);
  for (const char* found :
       {"safe", "invariant", "partitions", "coalition", "convention", "requirements", "work"})
    EXPECT_EQ(without[found], with[found]) << found;
  EXPECT_FALSE(with["coalition"]["critical_pairs"].empty());
  EXPECT_EQ(with["convention"].size(), 2U);
}

}  // namespace
}  // namespace coordreq
