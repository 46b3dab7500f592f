#include "answers/blind/blind_layers.hpp"

#include <algorithm>
#include <deque>
#include <memory>
#include <utility>

#include "base/index.hpp"
#include "choices/independent_actions.hpp"
#include "engine/find_levels.hpp"
#include "engine/level_messages.hpp"

namespace coordreq {
namespace {

const RowEngine& engine_of(const BlindProblem& problem) {
  return problem.sources.projections.grouping().engine();
}

/// The levels of Z, but 1 in K where a cell is not in B_1. @param common B_1; null: Z_1
LevelMap first_levels(const BlindProblem& problem, const CellSet* common) {
  const RowEngine& engine = engine_of(problem);
  return problem.layers.layers_of.visit([&]<class Level>(const LevelRows<Level>& layers) {
    auto levels = engine.make_levels<Level>(engine.posts(), problem.interned);
    std::vector<Level> cells(at(levels.row_length()) + kLevelBlock / sizeof(Level));
    const RowShare::Range local = local_rows(engine.share(), levels.rows());
    for (std::int64_t r = local.begin; r < local.end; ++r) {
      std::copy_n(layers.row(r), layers.row_length(), cells.begin());
      if (common != nullptr) {
        for_each_bit(problem.sources.invariant.row(r), [&](std::int64_t x) {
          const Word word = common->row(r)[at(x / CellSet::kWordBits)];
          if ((word >> (x % CellSet::kWordBits) & 1U) == 0) cells[at(x)] = 1;
        });
      }
      levels.put(r, cells.data());
    }
    if (engine.share() != nullptr) {
      LevelMessages<Level>(levels).exchange(
          [](std::int64_t) { return true; },
          [&levels](std::int64_t row, const Level* others) { levels.put(row, others); });
    }
    return LevelMap(std::move(levels));
  });
}

LevelMap run(const BlindProblem& problem, LevelMap& start, const WaveWatch& watch, ThreadTeam& team,
             WaveCounts& counts) {
  const SilentSources& sources = problem.sources;
  const auto make = [&]<class Level>(Level) -> std::unique_ptr<RowOperator<Level>> {
    return std::make_unique<IndependentActions<Level>>(sources.projections, sources.invariant, team.size());
  };
  const LevelProblem levels{.spared = problem.terminal,
                            .equal = sources.projections.equal_work(),
                            .limit = problem.max_delay.value_or(-1),
                            .make8 = [&] { return make(std::uint8_t{}); },
                            .make16 = [&] { return make(std::uint16_t{}); },
                            .make32 = [&] { return make(std::uint32_t{}); }};
  WaveWatch inner_watch = watch;
  inner_watch.resumed = &start;
  return find_levels(engine_of(problem), problem.hull, levels, inner_watch, team, counts);
}

}  // namespace

LevelMap find_blind_levels(const BlindProblem& problem, const WaveWatch& watch, ThreadTeam& team,
                           WaveCounts& counts) {
  if (watch.resumed != nullptr) return run(problem, *watch.resumed, watch, team, counts);
  // Without any step B_1 is not needed.
  if (problem.max_delay == 0) return first_levels(problem, nullptr);
  const LevelMap& layers = problem.layers.layers_of;
  const std::optional<CellSet> common =
      find_common_cells(problem.sources, layers, find_silent_tables(problem.sources, layers, 1, team), team);
  LevelMap start = first_levels(problem, common ? &*common : nullptr);
  return common ? run(problem, start, watch, team, counts) : std::move(start);
}

LevelMap find_blind_delays(const BlindProblem& problem, const LevelMap& levels, std::int64_t fixed_point,
                           ThreadTeam& team) {
  const RowEngine& engine = engine_of(problem);
  const CellSet& invariant = problem.sources.invariant;
  return levels.visit([&]<class Level>(const LevelRows<Level>& layers) {
    constexpr Level kTop = LevelRows<Level>::kTop;
    const bool is_cut = problem.max_delay && *problem.max_delay == fixed_point;
    const Level most = is_cut ? static_cast<Level>(fixed_point + 1) : kTop;
    auto delays = engine.make_levels<Level>(engine.posts());
    IndependentActions<Level> actions(problem.sources.projections, invariant, team.size());
    const PostReader<Level> first(engine, layers);
    std::deque<PostReader<Level>> readers(at(team.size()), first);
    first.for_each_local_row(team, [&](ThreadTeam::Range range, int worker) {
      PostReader<Level>& posts = readers[at(worker)];
      std::vector<Level> least(posts.lanes(), 0), cells(posts.lanes(), 0);
      for (RowPosition position(engine.grid(), range.begin); position.row < range.end;
           position.advance(engine.grid())) {
        posts.enter(position.row);
        const ConstRow terminal =
            problem.terminal == nullptr ? ConstRow() : problem.terminal->row(position.row);
        if (!any_set(invariant.row(position.row)) && !any_set(terminal)) continue;
        actions.find_minimum(position, posts, least.data(), worker);
        std::ranges::fill(cells, Level{0});
        for_each_bit(terminal, [&](std::int64_t x) { cells[at(x)] = kTop; });
        for_each_bit(invariant.row(position.row), [&](std::int64_t x) {
          cells[at(x)] = least[at(x)] == kTop ? most : static_cast<Level>(least[at(x)] + 1);
        });
        delays.put(position.row, cells.data());
      }
    });
    return LevelMap(std::move(delays));
  });
}

}  // namespace coordreq
