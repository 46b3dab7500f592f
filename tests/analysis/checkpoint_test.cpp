// What is taken up from a checkpoint ends in the same results and says the same of them, from any point on.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "analysis/analyze.hpp"
#include "results/scratch_folder.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// @param more keys, each after a comma
ProblemSpec spec_with(const std::string& more) {
  return read_spec(R"({"coordreq": 1, "name": "small",
    "states": [{"name": "x", "lower": 0, "upper": 7, "step": 1}, {"name": "y", "lower": 0, "upper": 7, "step": 1}],
    "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [-1, 0, 1]}],
    "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
    "dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u", "y": "y + v"}},
    "abstraction": {"cells": "half_open", "safe": "center"}, "safe": "x + y <= 10",
    "output": {"controller": true, "actions": true, "layers": true, "abstraction": true})" +
                       more + "}",
                   "test");
}

/// Without what is that of one run: times, memory, and the work that was left to it.
Json said(Json summary) {
  for (const char* own : {"seconds", "work", "peak_memory_bytes"}) summary.erase(own);
  return summary;
}

class ResumedAnalysis : public testing::Test {
 protected:
  AnalysisOptions options(bool resume) {
    AnalysisOptions result{.output = folder_ / "results.h5"};
    result.checkpoint =
        CheckpointOptions{.file = folder_ / "saved", .every_seconds = resume ? 1e9 : 0.0, .resume = resume};
    return result;
  }

  /// All checkpoints that a run leaves on its way. @param summary what it says in the end
  std::set<std::string> checkpoints(const ProblemSpec& spec, Json& summary) {
    std::set<std::string> found;
    AnalysisOptions own = options(false);
    own.progress = [&](const Progress& /*progress*/) {
      if (std::filesystem::exists(folder_ / "saved")) found.insert(sample::bytes_of(folder_ / "saved"));
    };
    summary = said(analyze(spec, own, team_));
    return found;
  }

  void expect_the_same_from_each(const ProblemSpec& spec, const std::string& last_stage) {
    Json summary;
    const std::set<std::string> found = checkpoints(spec, summary);
    const std::string results = sample::bytes_of(folder_ / "results.h5");
    bool has_last = false;
    for (const std::string& checkpoint : found) {
      has_last = has_last ||
                 checkpoint.find(R"({"stage":")" + last_stage + R"(","finished":true)") != std::string::npos;
      std::filesystem::remove(folder_ / "results.h5");
      sample::write_bytes(folder_ / "saved", checkpoint);
      EXPECT_EQ(said(analyze(spec, options(true), team_)), summary);
      EXPECT_EQ(sample::bytes_of(folder_ / "results.h5"), results);
      EXPECT_FALSE(std::filesystem::exists(folder_ / "saved"));
    }
    EXPECT_TRUE(has_last) << last_stage;
    EXPECT_GT(found.size(), 3U);
    summary_ = std::move(summary);
  }

  sample::ScratchFolder folder_;
  ThreadTeam team_{1};
  Json summary_;
};

TEST_F(ResumedAnalysis, SaysTheSameOfPartitionsNetworksAndConventions) {
  expect_the_same_from_each(spec_with(R"(, "network": {"delay": 2},
    "coordination": {"partitions": "all", "horizon": 2, "convention": true},
    "requirements": [{"name": "r", "where": "x <= 0.1 and x > 0 and y <= 0.1 and y > 0", "invariant": true}])"),
                            "convention");
  // Else the numbers that are kept beside the cells would not be seen to be.
  for (const Json& agent : summary_["convention"]) {
    EXPECT_GT(agent["full"], 0);
    EXPECT_GT(agent["mean"], 0);
  }
}

TEST_F(ResumedAnalysis, SaysTheSameOfGoals) {
  expect_the_same_from_each(spec_with(R"(, "goal": "x >= 6.5", "coordination": {"convention": true})"),
                            "convention");
}

TEST_F(ResumedAnalysis, SaysTheSameOfAgentsThatHeedTheNetwork) {
  expect_the_same_from_each(
      spec_with(R"(, "network": {"weakly_hard": {"misses": 1, "window": 3}, "resynthesise": true})"),
      "network");
}

}  // namespace
}  // namespace coordreq
