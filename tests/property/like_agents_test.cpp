#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "engine/join_rows.hpp"
#include "model/model.hpp"
#include "reach/table_shapes.hpp"
#include "spec/read_spec.hpp"
#include "support/agreement.hpp"
#include "support/level_rows.hpp"
#include "support/random_goal.hpp"
#include "support/random_like_agents.hpp"

// Agents that are alike: what is found once, for one order of them, is what holds for each.
namespace coordreq {
namespace {

/// Rows along several dimensions hold the same in other places.
void expect_same_cells(const FastAnalysis& fast, const FastAnalysis& joined) {
  const UniformGrid& grid = fast.abstraction.grid;
  for (std::int64_t x = 0; x < grid.cells(); ++x) {
    std::int64_t like = 0;
    for (std::size_t i = 0; i < grid.size(); ++i)
      like += grid.index(x, i) * joined.abstraction.grid.stride(i);
    if (!fast.safe.test(x)) continue;
    RC_ASSERT(joined.invariance.collision_time.at(like) == fast.invariance.collision_time.at(x));
    if (!fast.invariance.invariant.test(x)) continue;
    for (std::size_t p = 0; p < fast.layers.size(); ++p)
      RC_ASSERT(joined.layers[p].layers_of.at(like) == fast.layers[p].layers_of.at(x));
  }
}

/// Work that was broken off without symmetry, some rows of it done and some not.
void expect_same_when_resumed(const FastAnalysis& fast, ThreadTeam& team) {
  const std::optional<RowSymmetry> symmetry =
      fast.answers->context.symmetry(single_classes(fast.abstraction.inputs));
  const Synthesis synthesis = fast.answers->context.spec.controller.synthesis;
  if (!symmetry) return;
  auto levels = fast.engine.make_levels<std::uint8_t>(fast.safe, team);
  for (std::int64_t row = 0; row < levels.rows(); ++row) {
    if (*rc::gen::arbitrary<bool>()) put_levels_of(fast.invariance.collision_time, row, levels);
  }
  LevelMap begun(std::move(levels));
  const Invariance again =
      find_invariance(fast.engine, fast.hull, fast.safe, synthesis, {.resumed = &begun}, team,
                      {.symmetry = &*symmetry}, fast.answers->context.terminal_or_null());
  for (std::int64_t x = 0; x < fast.safe.cells(); ++x)
    RC_ASSERT(again.collision_time.at(x) == fast.invariance.collision_time.at(x));
}

void classify(const FastAnalysis& fast) {
  const std::size_t last = fast.layers.size() - 1;
  const bool has_layers = fast.layers[last].sizes.size() > 1;
  RC_CLASSIFY(fast.answers->context.like_agents.size() == 2, "two alike");
  RC_CLASSIFY(fast.answers->context.like_agents.size() == 3, "three alike");
  RC_CLASSIFY(fast.actions[last].symmetry.has_value(), "rows found once");
  RC_CLASSIFY(fast.actions[last].symmetry && has_layers, "rows found once, with layers");
  RC_CLASSIFY(fast.actions[last].symmetry && fast.answers->context.tiles, "and tiles");
  RC_CLASSIFY(fast.actions[last].symmetry && !fast.abstraction.tubes.empty(), "and tubes");
}

TEST(LikeAgents, GiveTheSameInWhateverOrder) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("one order of like agents stands for all", [&] {
    const ProblemSpec spec = read_spec(
        *rc::gen::inRange(0, 3) > 0 ? draw_like_agents() : perhaps_with_goal(draw_like_agents()), "alike");
    std::vector<std::size_t> order(spec.states.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (*rc::gen::arbitrary<bool>()) order = Model(spec, table_shapes(spec)).order();
    const FastAnalysis fast(spec, arranged(build_abstraction(spec, team), order), team);
    expect_agreement(fast, plainly(spec, fast), team);
    expect_same_when_resumed(fast, team);
    Abstraction abstraction = arranged(build_abstraction(spec, team), order);
    abstraction.grid = join_rows(abstraction);
    const FastAnalysis joined(spec, std::move(abstraction), team);
    expect_same_cells(fast, joined);
    classify(fast);
    RC_CLASSIFY(joined.actions.back().symmetry.has_value(), "rows along several dimensions found once");
  }));
}

/// Rows are added up, and posts of the canonical one of two rows lie in the other mostly.
TEST(LikeAgents, GiveTheSameBesideACoupledMotion) {
  const ProblemSpec spec = read_spec(R"json({"coordreq": 1, "name": "turning",
    "states": [{"name": "p0", "lower": 0, "upper": 5, "step": 1, "outside": "saturate"},
               {"name": "p1", "lower": 0, "upper": 5, "step": 1, "outside": "saturate"},
               {"name": "h", "lower": 0, "upper": 4, "count": 4, "outside": "periodic"},
               {"name": "y", "lower": -3, "upper": 3, "step": 1, "outside": "safe"},
               {"name": "x", "lower": -3, "upper": 3, "step": 0.5, "outside": "safe"}],
    "inputs": [{"name": "u0", "values": [-1, 0, 1]}, {"name": "u1", "values": [-1, 0, 1]},
               {"name": "u", "values": [-1, 1]}],
    "agents": [{"name": "a", "inputs": ["u0"]}, {"name": "b", "inputs": ["u1"]}, {"name": "c", "inputs": ["u"]}],
    "dynamics": {"time": "discrete", "period": 1,
                 "equations": {"p0": "5 - p0 + u0", "p1": "5 - p1 + u1", "h": "h + 1",
                               "x": "0.98*x + 0.2*u*y - 0.5*cos(1.6*h)", "y": "0.98*y - 0.2*u*x + 0.5*sin(1.6*h)"}},
    "safe": "x^2 + y^2 >= 1.5 or p0 + p1 >= 4", "abstraction": {"safe": "center"}})json",
                                     "turning");
  ThreadTeam team(2);
  const FastAnalysis fast(spec, team);
  EXPECT_FALSE(fast.engine.posts().is_cut());
  EXPECT_TRUE(fast.actions.back().symmetry.has_value());
  EXPECT_GT(fast.layers.back().sizes.size(), 2U);
  expect_agreement(fast, plainly(spec, fast), team);
}

/// Rows that nothing was left to do in have work again where a permuted row of theirs has changed.
TEST(LikeAgents, GiveTheSameForAListOfPartitions) {
  const ProblemSpec spec = read_spec(R"({"coordreq": 1, "name": "listed",
    "states": [{"name": "p0", "lower": 0, "upper": 6, "step": 1, "outside": "saturate"},
               {"name": "p1", "lower": 0, "upper": 6, "step": 1, "outside": "saturate"},
               {"name": "p2", "lower": 0, "upper": 6, "step": 1, "outside": "saturate"},
               {"name": "h", "lower": 0, "upper": 2, "count": 2, "outside": "periodic"},
               {"name": "y", "lower": -7, "upper": 7, "step": 1, "outside": "safe"}],
    "inputs": [{"name": "u0", "values": [0, 1]}, {"name": "u1", "values": [0, 1]}, {"name": "u2", "values": [0, 1]}],
    "agents": [{"name": "a", "inputs": ["u0"]}, {"name": "b", "inputs": ["u1"]}, {"name": "c", "inputs": ["u2"]}],
    "dynamics": {"time": "discrete", "period": 1,
                 "equations": {"p0": "5 - p0 + u0", "p1": "5 - p1 + u1", "p2": "5 - p2 + u2", "h": "h + 1", "y": "y - h"}},
    "safe": "p0 + p1 != 6 and p0 + p2 != 6 and p1 + p2 != 6",
    "coordination": {"partitions": [{"classes": [["a"], ["b", "c"]]}, {"classes": [["a"], ["b"], ["c"]]}]},
    "abstraction": {"safe": "center", "cells": "half_open"}})",
                                     "listed");
  ThreadTeam team(2);
  const FastAnalysis fast(spec, team);
  EXPECT_TRUE(fast.actions[1].symmetry.has_value());
  EXPECT_EQ(fast.layers[1].sizes, (std::vector<std::int64_t>{5580, 4260, 240, 0}));
  expect_agreement(fast, plainly(spec, fast), team);
}

}  // namespace
}  // namespace coordreq
