// Results files without one of the fast paths are those with all of them, to the byte. Those without which
// posts may be wider are attacked in abstraction_attack_test.cpp.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/analyze.hpp"
#include "results/scratch_folder.hpp"
#include "spec/read_spec.hpp"
#include "support/analysed_file.hpp"
#include "support/random_goal.hpp"
#include "support/random_like_agents.hpp"
#include "support/random_problem.hpp"
#include "support/without.hpp"

namespace coordreq {
namespace {

/// Switches that are tried on one random system.
constexpr std::size_t kSwitchesAtATime = 4;

std::vector<FastPath> paths_of_same_results() {
  std::vector<FastPath> result;
  for (const FastPath& path : kFastPaths) {
    if (path.keeps_results) result.push_back(path);
  }
  return result;
}

/// The bytes of the results file.
std::string file_bytes(const ProblemSpec& spec, ThreadTeam& team) {
  const sample::ScratchFolder folder;
  AnalysisOptions options;
  options.output = folder / "results.h5";
  static_cast<void>(analyze(spec, options, team));
  std::ostringstream bytes;
  bytes << std::ifstream(options.output, std::ios::binary).rdbuf();
  return bytes.str();
}

std::string draw_any_kind() {
  switch (*rc::gen::inRange(0, 5)) {
    case 0:
      return draw_like_agents();
    case 1:
      return draw_problem(RandomTime::any, RandomEdges::any, RandomAgents::many);
    case 2:
      return perhaps_with_goal(draw_problem());
    case 3:
      return storing_everything(draw_problem());
    default:
      return draw_problem(RandomTime::between_samples);
  }
}

TEST(FastPaths, NoneChangesResultsOfRandomSystems) {
  ThreadTeam team(2);
  const std::vector<FastPath> paths = paths_of_same_results();
  std::size_t next = 0;
  EXPECT_TRUE(rc::check("a path that is not taken leaves the file as it is", [&] {
    const std::string text = draw_any_kind();
    const ProblemSpec spec = read_spec(text, "random");
    const std::string expected = file_bytes(spec, team);
    for (std::size_t k = 0; k < kSwitchesAtATime; ++k, ++next) {
      const FastPath& path = paths[next % paths.size()];
      const Without off(path);
      RC_LOG(fmt::format("without {}\n{}\n", path.name, text));
      RC_ASSERT(file_bytes(spec, team) == expected);
    }
  }));
}

/// Two in a plane: of a size for which the order of the states is chosen, and most rows are equal.
std::string pair_in_a_plane() {
  std::string states;
  for (const char* name : {"a", "b", "c", "d"})
    states += fmt::format(R"({}{{"name": "{}", "lower": 0, "upper": 16, "step": 1}})",
                          states.empty() ? "" : ", ", name);
  return fmt::format(R"({{"coordreq": 1, "name": "plane", "states": [{}],
"inputs": [{{"name": "u", "values": [-1, 0, 1]}}, {{"name": "v", "values": [-1, 0, 1]}}],
"agents": [{{"name": "one", "inputs": ["u"]}}, {{"name": "two", "inputs": ["v"]}}],
"dynamics": {{"time": "discrete", "period": 1,
  "equations": {{"a": "a + u", "b": "b - u", "c": "c + v", "d": "d + v"}}}},
"safe": "max(abs(a - c), abs(b - d)) >= 2", "abstraction": {{"safe": "center", "cells": "half_open"}}}})",
                     states);
}

/// What these paths were made for.
TEST(FastPaths, NoneChangesResultsOfExamples) {
  ThreadTeam team(2);
  std::vector<ProblemSpec> specs{read_spec(pair_in_a_plane(), "plane")};
  for (const std::string name :
       {"circle", "gridworld_coarse", "aircraft_coarse", "intersection_coarse", "swap", "crossing_risk",
        "blind_crossing", "platoon_coalition", "crossing_first_come"})
    specs.push_back(read_spec_file(COORDREQ_CONFIGS "/" + name + ".json", std::cin));
  for (const ProblemSpec& spec : specs) {
    const std::string expected = file_bytes(spec, team);
    for (const FastPath& path : paths_of_same_results()) {
      const Without off(path);
      EXPECT_TRUE(file_bytes(spec, team) == expected) << spec.name << " without " << path.name;
    }
  }
}

}  // namespace
}  // namespace coordreq
