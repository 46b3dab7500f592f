// Several processes write the same bytes as one, on random systems: here processes are threads.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/analyze.hpp"
#include "spec/read_spec.hpp"
#include "support/random_goal.hpp"
#include "support/random_like_agents.hpp"
#include "support/random_problem.hpp"
#include "support/random_requirements.hpp"
#include "support/random_sight.hpp"
#include "support/random_silence.hpp"
#include "support/thread_ranks.hpp"

namespace coordreq {
namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "coordreq-ranks-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder");
    path_ = name;
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

std::string content(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return (std::ostringstream() << stream.rdbuf()).str();
}

struct Outcome {
  std::string file;
  Json summary;
};

/// What does not depend on how the work was done.
Json answer_of(Json summary) {
  for (const char* key : {"output", "threads", "seconds", "work", "peak_memory_bytes"}) summary.erase(key);
  return summary;
}

Outcome alone(const Folder& folder, const ProblemSpec& spec) {
  ThreadTeam team(1);
  const std::string path = folder.file("one.h5");
  const Json summary = analyze(spec, {.output = path}, team);
  return {content(path), answer_of(summary)};
}

Outcome together(const Folder& folder, const ProblemSpec& spec, int count, int threads) {
  const std::string path = folder.file("many.h5");
  fs::remove(path);
  Outcome outcome;
  ThreadRanks::run(count, [&](Ranks& ranks) {
    ThreadTeam team(threads);
    AnalysisOptions options{.output = path};
    options.ranks = &ranks;
    const Json summary = analyze(spec, options, team);
    if (ranks.rank() == 0) outcome.summary = answer_of(summary);
  });
  outcome.file = content(path);
  return outcome;
}

constexpr int kCounts[] = {1, 2, 3, 5, 8};

void expect_same(const Folder& folder, const ProblemSpec& spec) {
  const Outcome one = alone(folder, spec);
  EXPECT_FALSE(one.file.empty());
  for (const int count : kCounts) {
    const Outcome many = together(folder, spec, count, 1);
    EXPECT_EQ(many.summary, one.summary) << count << " ranks";
    EXPECT_TRUE(many.file == one.file) << count << " ranks";
  }
}

int draw(int low, int high) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(low, high + 1));
}

Json draw_problem_of_any_kind() {
  const RandomTime time = draw(0, 3) == 0 ? RandomTime::between_samples : RandomTime::any;
  const RandomAgents agents = draw(0, 3) == 0 ? RandomAgents::many : RandomAgents::few;
  Json spec = Json::parse(draw_problem(time, RandomEdges::any, agents));
  if (draw(0, 2) == 0) spec = Json::parse(perhaps_with_goal(spec.dump()));
  if (draw(0, 2) == 0) spec = Json::parse(with_sight(spec.dump()));
  if (draw(0, 2) == 0) spec = Json::parse(with_silence(spec.dump()));
  for (const char* part : {"controller", "actions", "layers", "abstraction"})
    spec["output"][part] = draw(0, 1) == 0;
  return spec;
}

/// With more questions than those for delays.
Json draw_questions() {
  Json spec = Json::parse(with_requirements(draw(0, 1) == 0 ? draw_team() : draw_problem()));
  spec["output"]["actions"] = draw(0, 3) == 0;
  spec["coordination"]["convention"] = draw(0, 1) == 0;
  const std::string first = spec["states"][0]["name"];
  if (draw(0, 1) == 0) {
    const std::string goal = first + (draw(0, 1) == 0 ? " <= " : " >= ") + std::to_string(draw(0, 5)) + ".5";
    const std::string then = *rc::gen::element<std::string>("safe", "over", "over", "stay", "return");
    const bool is_end = then == "over";
    spec["goal"] = Json{{"where", goal}, {"then", then}};
    spec["requirements"].push_back({{"name", "soon"}, {"where", "true"}, {"max_arrival", draw(0, 3)}});
    if (!is_end || draw(0, 1) == 0) return spec;
  }
  const int window = draw(1, 4);
  Json network;
  if (draw(0, 2) == 0) {
    network["loss"] = {0.125, 0.25};
    if (draw(0, 1) == 0) network["after_loss"] = 0.5;
    spec["risk"]["horizon"] = draw(1, 6);
    const bool is_given = spec.value("/controller/synthesis"_json_pointer, "") == "given";
    if (!is_given && draw(0, 1) == 0) spec["risk"]["coordinated"] = "safest";
  } else if (draw(0, 1) == 0) {
    network["delay"] = draw(0, 3);
  } else {
    network["weakly_hard"] = {{"misses", draw(0, window)}, {"window", window}};
  }
  network["resynthesise"] = draw(0, 1) == 0;
  spec["network"] = network;
  return spec;
}

void check_same(const Folder& folder, const ProblemSpec& spec) {
  const Outcome one = alone(folder, spec);
  const int threads = draw(1, 2);
  // Two of the counts: many problems say more than many counts.
  const int first = draw(0, 3);
  for (const int count : {kCounts[first], kCounts[draw(first + 1, 4)]}) {
    const Outcome many = together(folder, spec, count, threads);
    RC_ASSERT(many.summary.dump() == one.summary.dump());  // RapidCheck takes JSON for a text
    RC_ASSERT(many.file == one.file);
  }
  RC_CLASSIFY(one.summary["invariant"] > 0, "K is not empty");
}

TEST(ManyRanks, WriteTheBytesOfOneProcess) {
  const Folder folder;
  EXPECT_TRUE(rc::check("results of 1, 2, 3, 5 and 8 ranks",
                        [&] { check_same(folder, read_spec(draw_problem_of_any_kind().dump(), "random")); }));
}

TEST(ManyRanks, SumWhatTheyCountInFibresThatTheyShare) {
  const Folder folder;
  EXPECT_TRUE(rc::check("agents that see only themselves", [&] {
    const bool is_alike = draw(0, 3) == 0;
    const std::string text = with_sight(is_alike ? draw_like_agents() : draw_problem());
    check_same(folder, read_spec(text, "random"));
  }));
}

TEST(ManyRanks, CountCellsInWhichSilentAgentsHaveNothingToDo) {
  const Folder folder;
  EXPECT_TRUE(rc::check("agents that do what they are told", [&] {
    const bool is_alike = draw(0, 3) == 0;
    Json spec = Json::parse(with_silence(perhaps_with_goal(is_alike ? draw_like_agents() : draw_problem())));
    const bool is_one = spec["agents"].size() == 1;
    if (!is_one && draw(0, 2) == 0) {
      spec["network"] = {{"loss", 0.125}};
      spec["risk"] = {{"horizon", 3}};
    }
    check_same(folder, read_spec(spec.dump(), "random"));
  }));
}

TEST(ManyRanks, WorkOutAllOrdersOfAgentsThatAreAlike) {
  const Folder folder;
  EXPECT_TRUE(rc::check("agents that are alike", [&] {
    Json spec = Json::parse(draw(0, 2) > 0 ? draw_like_agents() : perhaps_with_goal(draw_like_agents()));
    // With all partitions few agents can change places in each of them.
    if (draw(0, 2) > 0) spec["coordination"].erase("partitions");
    // Then rows run along the last state, which is often none of an agent.
    spec["output"]["actions"] = draw(0, 2) > 0;
    check_same(folder, read_spec(spec.dump(), "alike"));
  }));
}

TEST(ManyRanks, AnswerAllQuestionsAsOneProcessDoes) {
  const Folder folder;
  EXPECT_TRUE(rc::check("goals, networks, conventions and requirements",
                        [&] { check_same(folder, read_spec(draw_questions().dump(), "random")); }));
}

/// One cell is lost a step, all of them in the last rank's rows first: more than 8 bits, and in one rank
/// only.
TEST(ManyRanks, LevelsBecomeWideEverywhereWhereTheyDoInOne) {
  const Folder folder;
  expect_same(folder, read_spec(R"json({"coordreq": 1, "name": "chain",
    "states": [{"name": "y", "lower": 0, "upper": 7, "step": 1},
               {"name": "x", "lower": 0, "upper": 599, "step": 1}],
    "inputs": [{"name": "u", "values": [0]}], "agents": [{"name": "a", "inputs": ["u"]}],
    "dynamics": {"time": "discrete", "period": 1, "equations": {"y": "y", "x": "x - (1 - min(y, 1)) + u"}},
    "safe": "x >= 0", "abstraction": {"safe": "center", "cells": "half_open"}})json",
                                "chain"));
}

/// Posts of one end lie at the other end: every rank meets rows of others far away.
TEST(ManyRanks, RowsMayMeetAnyOthers) {
  const Folder folder;
  for (const char* equation : {"-p", "p + v", "v"}) {
    expect_same(folder, read_spec(std::string(R"json({"coordreq": 1, "name": "jump",
      "states": [{"name": "p", "lower": -9, "upper": 9, "count": 18, "outside": "periodic"},
                 {"name": "v", "lower": -9, "upper": 9, "step": 1, "outside": "unsafe"}],
      "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "w", "values": [-1, 0, 2]}],
      "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["w"]}],
      "dynamics": {"time": "discrete", "period": 1, "equations": {"p": ")json") +
                                      equation + R"json(", "v": "v + u + w"}},
      "safe": "p + v <= 12 and v >= p - 11", "abstraction": {"safe": "center", "cells": "half_open"},
      "coordination": {"partitions": "all", "connection_delay": 1},
      "output": {"actions": true, "controller": true, "layers": true}})json",
                                  "jump"));
  }
}

/// Tables with entries for every cell: affine, of a map, of an update; in another order than that of the
/// spec, but where `output` binds it.
TEST(ManyRanks, DivideTablesByCells) {
  const Folder folder;
  const auto spec = [](const std::string& equations, const std::string& more) {
    return read_spec(R"json({"coordreq": 1, "name": "coupled",
      "states": [{"name": "q", "lower": 0, "upper": 12, "step": 1, "outside": "safe"},
                 {"name": "x", "lower": -1, "upper": 1, "step": 0.25, "outside": "saturate"},
                 {"name": "m", "lower": 0, "upper": 2, "step": 1, "discrete": true},
                 {"name": "v", "lower": -1, "upper": 1, "step": 0.5}],
      "inputs": [{"name": "u", "values": [-0.5, 0, 0.5]}, {"name": "w", "values": [-0.5, 0.5]}],
      "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["w"]}],
      "dynamics": {"time": "discrete", "period": 1, "equations": )json" +
                         equations + R"json(},
      "safe": "x + v <= 1.25 and q + m > 0", "abstraction": {"safe": "center"},
      "coordination": {"partitions": "all"})json" +
                         more + "}",
                     "coupled");
  };
  const char* const equations[] = {
      R"json({"q": "q + v", "m": "m", "x": "0.5 * x + 0.25 * v + 0.03 * q - 0.1 * m", "v": "v * 0.5 + u * w"})json",
      R"json({"q": "q + v", "m": "m", "x": "sin(x) * v + 0.03 * q * m", "v": "v * x + u * w"})json",
      R"json({"q": "q + u", "m": "if(q >= 3 and x + v > 0.5 and u > 0, 2, m)", "x": "x * v * q / 15", "v": "v"})json"};
  for (const char* equation : equations) {
    SCOPED_TRACE(equation);
    expect_same(folder, spec(equation, ""));
    expect_same(folder, spec(equation, R"json(, "output": {"abstraction": true, "controller": true})json"));
    expect_same(folder, spec(equation, R"json(, "controller": {"allow": "u <= 0 or x < 0.5"})json"));
    expect_same(folder, spec(equation, R"json(, "controller": {"allow": "u != w or q + m < 5"})json"));
  }
}

/// Rows that are added up, and meet rows of all others.
TEST(ManyRanks, HearOfACoupledMotion) {
  const Folder folder;
  expect_same(folder, read_spec(R"json({"coordreq": 1, "name": "turning",
    "states": [{"name": "h", "lower": 0, "upper": 8, "count": 8, "outside": "periodic"},
               {"name": "y", "lower": -6, "upper": 6, "step": 0.5, "outside": "safe"},
               {"name": "x", "lower": -6, "upper": 6, "step": 0.5, "outside": "safe"}],
    "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "w", "values": [-1, 0, 1, 2]}],
    "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["w"]}],
    "dynamics": {"time": "discrete", "period": 1,
                 "equations": {"x": "0.98*x + 0.2*u*y - 0.5 + 0.5*cos(0.8*h)", "y": "0.98*y - 0.2*u*x + 0.5*sin(0.8*h)",
                               "h": "h + w - u"}},
    "safe": "x^2 + y^2 >= 1.5"})json",
                                "turning"));
}

/// Enclosures of flows are found in parts: in full, as a sum, with tubes, and with a discrete state.
TEST(ManyRanks, DivideTheAbstraction) {
  const Folder folder;
  const auto spec = [](const std::string& equation, const std::string& more) {
    return read_spec(R"json({"coordreq": 1, "name": "flow",
      "states": [{"name": "x", "lower": -1, "upper": 1, "step": 0.25},
                 {"name": "v", "lower": -1, "upper": 1, "step": 0.5}],
      "inputs": [{"name": "u", "values": [-0.5, 0, 0.5]}, {"name": "w", "values": [-0.5, 0.5]}],
      "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["w"]}],
      "dynamics": {"time": "continuous", "period": 0.5, "equations": {"x": ")json" +
                         equation + R"json(", "v": "u * w"}},
      "safe": "x + v <= 1.5", "abstraction": {"safe": "center")json" +
                         more + R"json(},
      "output": {"abstraction": true, "layers": true}})json",
                     "flow");
  };
  for (const char* equation : {"sin(x) * v + u", "v + sin(u) - x", "v * v + w", "sin(v) - x"}) {
    expect_same(folder, spec(equation, ""));
    expect_same(folder, spec(equation, R"(, "between_samples": true)"));
  }
}

}  // namespace
}  // namespace coordreq
