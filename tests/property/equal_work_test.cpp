#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <optional>
#include <utility>

#include "answers/goal/arrival.hpp"
#include "choices/independent_actions.hpp"
#include "engine/join_rows.hpp"
#include "model/model.hpp"
#include "reach/table_shapes.hpp"
#include "spec/read_spec.hpp"
#include "support/agreement.hpp"
#include "support/random_problem.hpp"

// Work that is not done because equal work has been done gives what the work would have given: for every kind
// of tiles, whether or not there is much that is equal.
namespace coordreq {
namespace {

struct Found {
  std::vector<std::vector<std::int64_t>> levels;  ///< of K, then of each partition; 0 outside
  std::int64_t copied = 0;                        ///< rows
};

std::vector<std::int64_t> levels_of(const LevelMap& map, const CellSet& cells) {
  std::vector<std::int64_t> result;
  for (std::int64_t x = 0; x < map.cells(); ++x) result.push_back(cells.test(x) ? map.at(x) : 0);
  return result;
}

/// A goal: the cells of K with low indices.
CellSet corner(const FastAnalysis& fast, const CellSet& invariant) {
  const UniformGrid& grid = fast.abstraction.grid;
  CellSet result = invariant;
  for (std::int64_t x = 0; x < invariant.cells(); ++x) {
    if (!invariant.test(x)) continue;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (grid.index(x, i) > 1) result.reset(x);
    }
  }
  return result;
}

/// @param tiles null: no equal work is looked for
Found find(const FastAnalysis& fast, const Tiles* tiles, ThreadTeam& team) {
  const ProblemSpec& spec = fast.answers->context.spec;
  const Synthesis synthesis = spec.controller.synthesis;
  const Invariance k =
      find_invariance(fast.engine, fast.hull, fast.safe, synthesis, {}, team, {.tiles = tiles});
  Found found{.levels = {levels_of(k.collision_time, fast.safe)}, .copied = k.counts.rows_copied};
  const Controller controller{&fast.engine, &k.invariant, &k.collision_time, synthesis};
  WaveCounts arrival;
  const LevelMap nearness = find_nearness(fast.engine, fast.hull, k.invariant, corner(fast, k.invariant),
                                          synthesis, {}, team, arrival, tiles);
  found.levels.push_back(levels_of(nearness, k.invariant));
  found.copied += arrival.rows_copied;
  for (const PartitionActions& actions : fast.actions) {
    if (actions.grouping.size() < 2) continue;
    const Projections projections(controller, actions.grouping, team, {.tiles = tiles});
    WaveCounts counts;
    const LevelMap layers = find_layer_levels(fast.engine, fast.hull, k.invariant, projections, {},
                                              spec.coordination.max_delay, {}, team, counts);
    found.levels.push_back(levels_of(layers, k.invariant));
    found.copied += counts.rows_copied;
  }
  return found;
}

struct Copied {
  bool rows = false;
  bool units = false;
};

Copied expect_same_work(const FastAnalysis& fast, ThreadTeam& team) {
  const Found plain = find(fast, nullptr, team);
  RC_ASSERT(plain.copied == 0);
  Copied copied;
  for (const std::size_t leading : {fast.engine.outer(), fast.engine.across()}) {
    const std::optional<Tiles> tiles = Tiles::make(fast.engine, fast.hull, leading);
    if (!tiles) continue;
    const Found found = find(fast, &*tiles, team);
    RC_ASSERT(found.levels == plain.levels);
    (tiles->rows() == 1 ? copied.rows : copied.units) |= found.copied > 0;
  }
  return copied;
}

TEST(EqualWork, GivesTheSameLevels) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("copied rows equal rows worked out", [&] {
    const RandomAgents agents = *rc::gen::element(RandomAgents::few, RandomAgents::many);
    const ProblemSpec spec = read_spec(draw_problem(RandomTime::any, RandomEdges::any, agents), "random");
    Abstraction abstraction =
        arranged(build_abstraction(spec, team), Model(spec, table_shapes(spec)).order());
    if (!spec.controller.allow && *rc::gen::arbitrary<bool>()) abstraction.grid = join_rows(abstraction);
    const FastAnalysis fast(spec, std::move(abstraction), team);
    const Copied copied = expect_same_work(fast, team);
    RC_CLASSIFY(copied.rows, "rows copied");
    RC_CLASSIFY(copied.units, "units copied");
    RC_CLASSIFY(fast.answers->context.tiles.has_value(), "found to be worth it");
  }));
}

/// Two in a plane or on a torus; with rows across a and c, and along b and d, most rows look like others.
ProblemSpec two_in_a_plane(const std::string& edges) {
  std::string states;
  for (const char* name : {"a", "c", "b", "d"})
    states += fmt::format(R"({}{{"name": "{}", "lower": 0, {}}})", states.empty() ? "" : ", ", name, edges);
  return read_spec(fmt::format(R"({{"coordreq": 1, "name": "plane", "states": [{}],
"inputs": [{{"name": "u", "values": [-1, 0, 1]}}, {{"name": "v", "values": [-1, 0, 1]}}],
"agents": [{{"name": "one", "inputs": ["u"]}}, {{"name": "two", "inputs": ["v"]}}],
"dynamics": {{"time": "discrete", "period": 1,
  "equations": {{"a": "a + u", "b": "b + u", "c": "c + v", "d": "d - v"}}}},
"safe": "max(abs(a - c), abs(b - d)) >= 2", "abstraction": {{"safe": "center", "cells": "half_open"}}}})",
                               states),
                   "plane");
}

/// Rows of which only `allow` says something else: with y above 2 nothing turns back at the lower end.
TEST(EqualWork, IsNotEqualWhereAllowSaysSomethingElse) {
  ThreadTeam team(1);
  const ProblemSpec spec = read_spec(R"({"coordreq": 1, "name": "lanes",
"states": [{"name": "y", "lower": 0, "upper": 7, "step": 1}, {"name": "x", "lower": 0, "upper": 7, "step": 1}],
"inputs": [{"name": "u", "values": [-1, 1]}], "agents": [{"name": "one", "inputs": ["u"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"y": "y", "x": "x + u"}},
"controller": {"allow": "u < 0 or y <= 2"}, "safe": "true",
"abstraction": {"safe": "center", "cells": "half_open"}})",
                                     "lanes");
  const FastAnalysis fast(spec, team);
  EXPECT_EQ(fast.invariance.invariant.count(), 3 * 8);
  EXPECT_TRUE(expect_same_work(fast, team).rows);
}

TEST(EqualWork, GivesTheSameLevelsWhereOnlyDifferencesMatter) {
  ThreadTeam team(2);
  for (const std::string edges :
       {R"("upper": 6, "step": 1)", R"("upper": 6, "step": 1, "outside": "saturate")",
        R"("upper": 6, "step": 1, "outside": {"below": "safe"})",
        R"("upper": 7, "count": 7, "outside": "periodic")"}) {
    const ProblemSpec spec = two_in_a_plane(edges);
    std::int64_t most = 0;
    for (const auto& order :
         std::vector<std::vector<std::size_t>>{{0, 1, 2, 3}, {0, 2, 1, 3}, {3, 1, 0, 2}}) {
      for (const std::size_t along : {1U, 2U, 3U}) {
        Abstraction abstraction = arranged(build_abstraction(spec, team), order);
        abstraction.grid = join_rows(abstraction, along);
        const FastAnalysis fast(spec, std::move(abstraction), team);
        const Copied copied = expect_same_work(fast, team);
        most += copied.rows ? 1 : 0;
      }
    }
    EXPECT_GT(most, 3) << edges;
  }
}

/// Rows of which the ranges begin at the same places, and only the width of some tells them apart.
TEST(EqualWork, IsNotWhatOnlyTheWidthOfARangeMakesDifferent) {
  ThreadTeam team(2);
  const ProblemSpec spec = read_spec(R"json({"coordreq": 1, "name": "widths",
"states": [{"name": "x", "lower": 0, "upper": 31, "step": 1, "outside": "saturate"},
           {"name": "y", "lower": 0, "upper": 39, "step": 1, "outside": "saturate"}],
"inputs": [{"name": "u", "values": [0, 1]}, {"name": "v", "values": [-1, 0, 1]}],
"disturbances": [{"name": "w", "lower": 0, "upper": 1}],
"agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "discrete", "period": 1,
             "equations": {"x": "x - 0.05 + if(x >= 15.5 or u >= 1, w, 0)", "y": "y + v"}},
"safe": "x - 3*floor(x/3) <= 1 or y >= 3", "abstraction": {"safe": "center", "cells": "half_open"}})json",
                                     "widths");
  const FastAnalysis fast(spec, build_abstraction(spec, team), team);
  EXPECT_TRUE(expect_same_work(fast, team).rows);
  expect_agreement(fast, plainly(spec, fast), team);
}

}  // namespace
}  // namespace coordreq
