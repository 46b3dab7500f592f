// Work on fixed points that is taken up where it was broken off, on random systems and on chains with levels
// of more than 8 bits: the result is the same from any step on.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "answers/blind/answer.hpp"
#include "answers/blind/blind_layers.hpp"
#include "answers/invariance/safe_set.hpp"
#include "answers/network/network_safety.hpp"
#include "answers/risk/risk.hpp"
#include "answers/silence/answer.hpp"
#include "answers/silence/silent_actions.hpp"
#include "spec/read_spec.hpp"
#include "spec/sight.hpp"
#include "support/fast_engine.hpp"
#include "support/random_goal.hpp"
#include "support/random_problem.hpp"
#include "support/random_sight.hpp"
#include "support/random_silence.hpp"

namespace coordreq {
namespace {

std::vector<std::int64_t> levels_of(const LevelMap& map) {
  std::vector<std::int64_t> result;
  for (std::int64_t x = 0; x < map.cells(); ++x) result.push_back(map.at(x));
  return result;
}

template <class Level>
LevelMap read_levels(const RowEngine& engine, const NumberRows& bytes) {
  LevelRows<Level> levels = engine.make_levels<Level>(engine.posts());
  for (std::int64_t r = 0; r < levels.rows(); ++r) {
    levels.change_row(
        r, [&](Level* row) { std::memcpy(row, bytes.row(r), static_cast<std::size_t>(bytes.row_bytes())); });
  }
  return LevelMap(std::move(levels));
}

/// A copy of the levels that a step shows.
LevelMap copy_of(const RowEngine& engine, const WaveStep& step) {
  const NumberRows& bytes = step.state.front();
  if (bytes.number_bytes == 1) return read_levels<std::uint8_t>(engine, bytes);
  if (bytes.number_bytes == 2) return read_levels<std::uint16_t>(engine, bytes);
  return read_levels<std::uint32_t>(engine, bytes);
}

/// What one step of a fixed point was told.
struct Seen {
  LevelMap levels;
  std::int64_t layer = -1;
};

/// Every `stride`-th step.
WaveWatch recorder(const RowEngine& engine, std::vector<Seen>& seen, std::int64_t stride) {
  return {.step = [&engine, &seen, stride, count = std::int64_t{0}](const WaveStep& step) mutable {
    if (step.rows_left < 0 || step.rows_left > step.rows) throw std::logic_error("impossible rows");
    if (count++ % stride == 0) seen.push_back({copy_of(engine, step), step.layer});
  }};
}

/// Levels up to the layer, and those alone, have to be the ones of the end.
bool is_final(const Seen& seen, const std::vector<std::int64_t>& end) {
  const auto known = [&](std::int64_t level) { return level != LevelMap::kTop && level <= seen.layer; };
  for (std::size_t x = 0; x < end.size(); ++x) {
    const std::int64_t own = seen.levels.at(static_cast<std::int64_t>(x));
    if ((known(own) || known(end[x])) && own != end[x]) return false;
  }
  return true;
}

/// @returns whether every step of `find` leads to the same end, and tells the truth about it
template <class Find>
bool resumes(const RowEngine& engine, const Find& find, std::int64_t stride = 1) {
  std::vector<Seen> seen;
  const std::vector<std::int64_t> end = levels_of(find(recorder(engine, seen, stride)));
  for (Seen& one : seen) {
    if (!is_final(one, end)) return false;
    const WaveWatch watch{.resumed = &one.levels};
    if (levels_of(find(watch)) != end) return false;
  }
  return !seen.empty();
}

ProblemSpec draw_spec(RandomAgents agents) {
  const RandomTime time = *rc::gen::inRange(0, 4) == 0 ? RandomTime::between_samples : RandomTime::any;
  return read_spec(draw_problem(time, RandomEdges::any, agents), "random");
}

TEST(Resumed, CollisionTimesAreTheSameFromAnyStep) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("the invariance fixed point", [&] {
    const ProblemSpec spec = draw_spec(RandomAgents::few);
    const FastAnalysis fast(spec, team);
    RC_ASSERT(resumes(fast.engine, [&](const WaveWatch& watch) {
      return find_invariance(fast.engine, fast.hull, fast.safe, spec.controller.synthesis, watch, team)
          .collision_time;
    }));
  }));
}

TEST(Resumed, LayersAreTheSameFromAnyStep) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("the layers of every partition", [&] {
    const ProblemSpec spec = draw_spec(RandomAgents::few);
    const FastAnalysis fast(spec, team);
    for (const PartitionActions& actions : fast.actions) {
      RC_ASSERT(resumes(fast.engine, [&](const WaveWatch& watch) {
        WaveCounts counts;
        return find_layer_levels(fast.engine, fast.hull, fast.invariance.invariant, actions.projections, {},
                                 spec.coordination.max_delay, watch, team, counts);
      }));
    }
  }));
}

TEST(Resumed, BlindLayersAreTheSameFromAnyStep) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("the layers of agents that see only themselves", [&] {
    const ProblemSpec spec = read_spec(with_sight(draw_problem()), "random");
    const FastAnalysis fast(spec, team);
    bool goes_on = false;
    for (std::size_t p = 0; p < fast.layers.size(); ++p) {
      const PartitionSpec& partition = spec.coordination.partitions[p];
      if (partition.classes.size() == 1) continue;
      const ActionGrouping grouping(fast.engine, input_classes(spec, fast.abstraction.inputs, partition),
                                    team);
      const Projections projections(fast.controller, grouping, team, {}, true);
      ClassFibres fibres;
      for (const auto& agents : partition.classes)
        fibres.emplace_back(std::in_place, fast.engine.grid(), seen_states(spec, agents));
      const SilentSources sources{projections, fast.invariance.invariant, fibres};
      const BlindProblem problem{sources, fast.hull, fast.layers[p], spec.coordination.max_delay};
      const auto find = [&](const WaveWatch& watch) {
        WaveCounts counts;
        return find_blind_levels(problem, watch, team, counts);
      };
      std::vector<Seen> seen;
      const std::vector<std::int64_t> end = levels_of(find(recorder(fast.engine, seen, 1)));
      RC_ASSERT(end == levels_of(fast.answers->get<Blind>().partitions[p].layers.layers_of));
      for (Seen& one : seen) {
        const WaveWatch watch{.resumed = &one.levels};
        RC_ASSERT(levels_of(find(watch)) == end);
      }
      goes_on = goes_on || !seen.empty();
    }
    RC_CLASSIFY(goes_on, "a wave after B_1");
  }));
}

TEST(Resumed, SilenceIsTheSameFromAnyStep) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("the layers of agents that do what they are told", [&] {
    const ProblemSpec spec = read_spec(with_silence(perhaps_with_goal(draw_problem())), "random");
    const FastAnalysis fast(spec, team);
    const CellSet& set = silence_set(*fast.answers);
    const CellSet* const terminal = fast.answers->context.terminal_or_null();
    const CellSet nonterminal = terminal == nullptr ? set : subset_of(set, *terminal, false, nullptr);
    bool goes_on = false;
    for (std::size_t p = 0; p < fast.layers.size(); ++p) {
      const SilentActions actions(*fast.answers, {spec.silence->actions, "actions"},
                                  spec.coordination.partitions[p].classes, nonterminal, team);
      const auto find = [&](const WaveWatch& watch) {
        WaveCounts counts;
        return find_layer_levels(fast.engine, fast.hull, set, actions.projections, {},
                                 spec.coordination.max_delay, watch, team, counts, terminal);
      };
      std::vector<Seen> seen;
      const std::vector<std::int64_t> end = levels_of(find(recorder(fast.engine, seen, 1)));
      RC_ASSERT(end == levels_of(silence_of(*fast.answers, p).layers.layers_of));
      for (Seen& one : seen) {
        const WaveWatch watch{.resumed = &one.levels};
        RC_ASSERT(levels_of(find(watch)) == end);
      }
      goes_on = goes_on || !seen.empty();
    }
    RC_CLASSIFY(goes_on, "a wave");
  }));
}

/// One cell is lost a step, so that 300 cells need more than 8 bits.
TEST(Resumed, WideLevelsAreTheSameFromAnyStep) {
  const ProblemSpec spec = read_spec(R"json({"coordreq": 1, "name": "chain",
"states": [{"name": "x", "discrete": true, "lower": 0, "upper": 2, "step": 1, "outside": "unsafe"},
{"name": "y", "discrete": true, "lower": 0, "upper": 99, "step": 1, "outside": "unsafe"}],
"inputs": [{"name": "u", "values": [0]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "discrete", "period": 1,
  "equations": {"x": "x + if(y >= 99, 1, 0)", "y": "if(y >= 99, 0, y + 1) + u"}},
"safe": "true", "abstraction": {"cells": "half_open"}})json",
                                     "chain");
  for (const int threads : {1, 2}) {
    ThreadTeam team(threads);
    const FastAnalysis fast(spec, team);
    EXPECT_EQ(fast.invariance.iterations, 301);
    EXPECT_TRUE(resumes(
        fast.engine,
        [&](const WaveWatch& watch) {
          return find_invariance(fast.engine, fast.hull, fast.safe, spec.controller.synthesis, watch, team)
              .collision_time;
        },
        7));
  }
}

std::string with_any_network(std::string problem, bool resynthesise) {
  problem.erase(problem.rfind('}'));
  return problem + R"(, "network": {"weakly_hard": {"misses": 2, "window": 4}, "resynthesise": )" +
         (resynthesise ? "true" : "false") + "}}";
}

CellSet read_set(const NumberRows& bytes, const CellSet& like) {
  CellSet set(like.rows(), like.row_length());
  for (std::int64_t r = 0; r < set.rows(); ++r)
    std::memcpy(set.row(r).data(), bytes.row(r), static_cast<std::size_t>(bytes.row_bytes()));
  return set;
}

TEST(Resumed, SetsOfANetworkAreTheSameFromAnyStep) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("W(q) of both kinds", [&] {
    const std::string text = draw_problem(RandomTime::any);
    for (const bool resynthesise : {false, true}) {
      const ProblemSpec spec = read_spec(with_any_network(text, resynthesise), "random");
      const FastAnalysis fast(spec, team);
      const NetworkProblem problem = network_problem(spec, fast.controller, fast.hull);
      std::vector<std::vector<CellSet>> seen;
      const NetworkWatch record{.step = [&](const WaveStep& step) {
        if (step.state.empty()) return;
        std::vector<CellSet>& sets = seen.emplace_back();
        for (const NumberRows& bytes : step.state) sets.push_back(read_set(bytes, fast.invariance.invariant));
      }};
      const std::vector<CellSet> end = find_network_safety(problem, record, team).safe;
      RC_ASSERT(!seen.empty());
      for (std::vector<CellSet>& sets : seen)
        RC_ASSERT(find_network_safety(problem, {.resumed = &sets}, team).safe == end);
    }
  }));
}

TEST(Resumed, RisksAreTheSameFromAnyStep) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("V of all modes, and the rate", [&] {
    std::string text = draw_problem(RandomTime::any);
    text.erase(text.rfind('}'));
    const ProblemSpec spec =
        read_spec(text + R"(, "network": {"loss": [0.125, 0.25], "after_loss": 0.5}})", "random");
    const FastAnalysis fast(spec, team);
    const ExpectedRisks expected(*spec.network);
    const RiskProblem problem{
        .network = network_problem(spec, fast.controller, fast.hull), .expected = &expected, .horizon = 6};
    std::vector<RiskState> seen;
    const RiskWatch record{.step = [&](const WaveStep& step, std::int64_t steps) {
      if (step.state.empty()) return;
      RiskState& state =
          seen.emplace_back(RiskState{steps, first_risks(fast.invariance.invariant, 2, nullptr)});
      for (std::size_t mode = 0; mode < 2; ++mode) {
        for (std::int64_t r = 0; r < step.state[mode].rows; ++r)
          state.risks[mode].change_row(r, [&](std::uint32_t* row) {
            std::memcpy(row, step.state[mode].row(r), static_cast<std::size_t>(step.state[mode].row_bytes()));
          });
      }
    }};
    const Risk end = find_risk(problem, record, team);
    for (RiskState& state : seen) {
      const Risk again = find_risk(problem, {.resumed = &state}, team);
      RC_ASSERT(again.rate == end.rate);
      for (std::size_t mode = 0; mode < 2; ++mode) {
        for (std::int64_t r = 0; r < end.risks[mode].rows(); ++r) {
          const std::uint32_t* const row = end.risks[mode].row(r);
          RC_ASSERT(std::equal(row, row + end.risks[mode].row_length(), again.risks[mode].row(r)));
        }
      }
    }
  }));
}

}  // namespace
}  // namespace coordreq
