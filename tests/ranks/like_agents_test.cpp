// Agents that are alike, where several processes share the work: here processes are threads.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <atomic>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "answers/answers.hpp"
#include "answers/ground/answer.hpp"
#include "answers/invariance/invariance.hpp"
#include "answers/plan.hpp"
#include "base/json.hpp"
#include "model/model.hpp"
#include "reach/make_model.hpp"
#include "spec/read_spec.hpp"
#include "support/level_rows.hpp"
#include "support/random_like_agents.hpp"
#include "support/thread_ranks.hpp"

namespace coordreq {
namespace {

constexpr int kRanks[] = {1, 2, 3, 5, 9};
/// More do not exchange agents.
constexpr int kMostThatExchange = 8;

/// What one process finds without a word of agents.
struct Expected {
  CellSet safe;
  LevelMap collision_time;
};

Expected alone(const Model& model) {
  ThreadTeam team(1);
  Answers answers(model);
  run_stages(ground_stages(model.spec()), answers, {.team = team});
  const Ground& ground = answers.ground;
  Invariance found =
      find_invariance(*ground.engine, *ground.hull, ground.safe, model.spec().controller.synthesis, {}, team);
  return {ground.safe, std::move(found.collision_time)};
}

/// What the rows of a rank hold after work that was broken off, and that knew no symmetry: some rows of
/// it are done, and some are not.
LevelMap begun(const Ground& ground, const Expected& expected, const std::vector<int>& is_done,
               ThreadTeam& team) {
  auto levels = ground.engine->make_levels<std::uint8_t>(ground.safe, team);
  for (const RowShare::Range run : ground.share->held()) {
    for (std::int64_t row = run.begin; row < run.end; ++row) {
      if (is_done[static_cast<std::size_t>(row) % is_done.size()] != 0)
        put_levels_of(expected.collision_time, row, levels);
    }
  }
  return LevelMap(std::move(levels));
}

/// Looks at one rank. @returns whether rows are found once there
bool check_rank(const Model& model, const Expected& expected, const std::vector<int>& is_done, Ranks& ranks,
                std::atomic<int>& wrong) {
  ThreadTeam team(1);
  Answers answers(model, &ranks);
  run_stages(ground_stages(model.spec()), answers, {.team = team});
  const Ground& ground = answers.ground;
  const std::optional<RowSymmetry> symmetry = ground.symmetry(single_classes(ground.abstraction->inputs));
  const auto find = [&](const WaveWatch& watch) {
    return find_invariance(*ground.engine, *ground.hull, ground.safe, model.spec().controller.synthesis,
                           watch, team,
                           {.tiles = ground.equal_work(), .symmetry = symmetry ? &*symmetry : nullptr});
  };
  const Invariance found = find({});
  LevelMap start = begun(ground, expected, is_done, team);
  const Invariance again = find({.resumed = &start});
  // In ghost rows, too.
  for (const RowShare::Range run : ground.share->held()) {
    const std::int64_t length = ground.safe.row_length();
    for (std::int64_t x = run.begin * length; x < run.end * length; ++x) {
      wrong += ground.safe.test(x) != expected.safe.test(x) ? 1 : 0;
      if (!ground.safe.test(x)) continue;
      wrong += found.collision_time.at(x) != expected.collision_time.at(x) ? 1 : 0;
      wrong += again.collision_time.at(x) != expected.collision_time.at(x) ? 1 : 0;
    }
  }
  return symmetry.has_value();
}

TEST(LikeAgentsOfManyRanks, AreLookedAtOnceByWhoeverHasTheFirst) {
  EXPECT_TRUE(rc::check("K of 1, 2, 3, 5 and 9 ranks, from the start and resumed", [] {
    Json problem = Json::parse(draw_like_agents());
    problem["coordination"].erase("partitions");  // in all of which few agents can change places
    // Then rows run along the last state, which is often none of an agent.
    problem["output"]["actions"] = *rc::gen::weightedElement<bool>({{3, true}, {1, false}});
    const ProblemSpec spec = read_spec(problem.dump(), "alike");
    const Model model = make_model(spec);
    const Expected expected = alone(model);
    const auto is_done = *rc::gen::container<std::vector<int>>(23, rc::gen::inRange(0, 2));
    bool is_once = false;
    for (const int count : kRanks) {
      std::atomic<int> wrong = 0, symmetries = 0;
      ThreadRanks::run(count, [&](Ranks& ranks) {
        symmetries += check_rank(model, expected, is_done, ranks, wrong) ? 1 : 0;
      });
      RC_ASSERT(wrong == 0);
      RC_ASSERT(symmetries == 0 || (symmetries == count && count <= kMostThatExchange));
      is_once = is_once || (count > 1 && symmetries > 0);
    }
    RC_CLASSIFY(is_once, "rows found once");
  }));
}

/// Own rows, and those of them that it works out.
struct OwnRows {
  std::int64_t all = 0;
  std::int64_t firsts = 0;
};

/// [rank] of two, on a grid of 64 x 64 places of two agents; the rows run along a state that is neither's.
std::vector<OwnRows> rows_of_two(const std::string& inputs_of_second) {
  const ProblemSpec spec = read_spec(R"json({"coordreq": 1, "name": "apart",
    "states": [{"name": "p0", "lower": 0, "upper": 63, "step": 1, "outside": "saturate"},
               {"name": "p1", "lower": 0, "upper": 63, "step": 1, "outside": "saturate"},
               {"name": "t", "lower": 0, "upper": 3, "step": 1, "outside": "saturate"}],
    "inputs": [{"name": "u0", "values": [-1, 0, 1]}, {"name": "u1", "values": [)json" +
                                         inputs_of_second + R"json(]}],
    "agents": [{"name": "a", "inputs": ["u0"]}, {"name": "b", "inputs": ["u1"]}],
    "dynamics": {"time": "discrete", "period": 1,
                 "equations": {"p0": "p0 + u0", "p1": "p1 + u1", "t": "t + 1"}},
    "safe": "p0 != p1 or t <= 2", "abstraction": {"safe": "center", "cells": "half_open"},
    "output": {"actions": true}})json",
                                     "apart");
  const Model model = make_model(spec);
  std::vector<OwnRows> rows(2);
  ThreadRanks::run(2, [&](Ranks& ranks) {
    ThreadTeam team(1);
    Answers answers(model, &ranks);
    run_stages(ground_stages(spec), answers, {.team = team});
    const std::optional<RowSymmetry> symmetry =
        answers.ground.symmetry(single_classes(answers.ground.abstraction->inputs));
    OwnRows& mine = rows[static_cast<std::size_t>(ranks.rank())];
    const RowShare::Range own = answers.ground.share->own();
    for (std::int64_t row = own.begin; row < own.end; ++row)
      mine.firsts += !symmetry || symmetry->is_canonical(row) ? 1 : 0;
    mine.all = own.end - own.begin;
  });
  return rows;
}

TEST(LikeAgentsOfManyRanks, DivideTheRowsThatAreWorkedOut) {
  const std::vector<OwnRows> alike = rows_of_two("-1, 0, 1");
  EXPECT_EQ(alike[0].firsts + alike[1].firsts, 64 * 65 / 2);
  EXPECT_LT(std::abs(alike[0].firsts - alike[1].firsts), 64 * 64 / 10);
  EXPECT_LT(alike[0].all, alike[1].all * 2 / 3);
  const std::vector<OwnRows> different = rows_of_two("0, 1");
  EXPECT_EQ(different[0].firsts + different[1].firsts, 64 * 64);
  EXPECT_LT(std::abs(different[0].all - different[1].all), 64 * 64 / 10);
}

}  // namespace
}  // namespace coordreq
