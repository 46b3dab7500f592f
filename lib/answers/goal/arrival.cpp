#include "answers/goal/arrival.hpp"

#include <algorithm>
#include <utility>

#include "choices/joint_actions.hpp"
#include "engine/different_rows.hpp"
#include "engine/find_levels.hpp"

namespace coordreq {

LevelMap first_nearness(const RowEngine& engine, const CellSet& invariant, const CellSet& goal,
                        bool interned) {
  auto levels = engine.make_levels<std::uint8_t>(engine.posts(), interned);
  std::vector<std::uint8_t> cells(static_cast<std::size_t>(levels.row_length()) + kLevelBlock);
  for (const RowShare::Range run : held_rows(levels.share(), levels.rows())) {
    for (std::int64_t r = run.begin; r < run.end; ++r) {
      std::fill(cells.begin(), cells.end(), 0);
      for_each_bit(invariant.row(r), [&](std::int64_t x) { cells[static_cast<std::size_t>(x)] = 1; });
      for_each_bit(goal.row(r), [&](std::int64_t x) {
        cells[static_cast<std::size_t>(x)] = LevelRows<std::uint8_t>::kTop;
      });
      levels.put(r, cells.data());
    }
  }
  return LevelMap(std::move(levels));
}

std::int32_t arrival_at(const LevelMap& nearness, std::int64_t cell) {
  return nearness.visit([cell](const auto& levels) {
    return arrival_of(levels.row(cell / levels.row_length())[cell % levels.row_length()]);
  });
}

LevelMap find_nearness(const RowEngine& engine, const RowHull& hull, const CellSet& invariant,
                       const CellSet& goal, Synthesis synthesis, const WaveWatch& watch, ThreadTeam& team,
                       WaveCounts& counts, const Tiles* tiles) {
  const ActionGrouping grouping(engine, single_classes(engine.abstraction().inputs), team);
  const int workers = team.size();
  const LevelProblem problem{
      .equal = {tiles, tiles == nullptr ? nullptr : &tiles->tables()},
      .make8 = [&] { return make_joint_actions<std::uint8_t>(grouping, synthesis, true, workers); },
      .make16 = [&] { return make_joint_actions<std::uint16_t>(grouping, synthesis, true, workers); },
      .make32 = [&] { return make_joint_actions<std::uint32_t>(grouping, synthesis, true, workers); }};
  LevelMap start;
  WaveWatch inner_watch = watch;
  if (inner_watch.resumed == nullptr) {
    start = first_nearness(engine, invariant, goal, tiles != nullptr);
    inner_watch.resumed = &start;
  }
  return find_levels(engine, hull, problem, inner_watch, team, counts);
}

CellSet winning_cells(const LevelMap& nearness, ThreadTeam& team) {
  CellSet winning(nearness.rows(), nearness.row_length());
  nearness.visit([&](const auto& levels) {
    for_each_held_row(team, levels.share(), levels.rows(), 256, [&](ThreadTeam::Range range, int) {
      for (std::int64_t r = range.begin; r < range.end; ++r) {
        const auto* const row = levels.row(r);
        const MutableRow bits = winning.row(r);
        levels.shape().for_each_run([&](std::int64_t lane, std::int64_t count) {
          for (std::int64_t x = lane; x < lane + count; ++x) {
            if (row[x] > 1)
              bits[static_cast<std::size_t>(x / CellSet::kWordBits)] |= Word{1} << (x % CellSet::kWordBits);
          }
        });
      }
    });
  });
  return winning;
}

std::optional<std::int32_t> longest_arrival(const LevelMap& nearness, ThreadTeam& team) {
  std::vector<std::int32_t> longest(static_cast<std::size_t>(team.size()), -1);
  nearness.visit([&]<class Level>(const LevelRows<Level>& levels) {
    const DifferentRows<Level> rows(levels);
    team.for_each(rows.size(), 256, [&](ThreadTeam::Range range, int worker) {
      std::int32_t& local_longest = longest[static_cast<std::size_t>(worker)];
      rows.for_each(range, [&](const Level* row, std::int64_t) {
        levels.shape().for_each_run([&](std::int64_t lane, std::int64_t count) {
          for (std::int64_t x = lane; x < lane + count; ++x) {
            if (row[x] > 1) local_longest = std::max(local_longest, arrival_of(row[x]));
          }
        });
      });
    });
  });
  const std::int32_t local_longest = *std::max_element(longest.begin(), longest.end());
  const RowShare* const share = nearness.share();
  const auto all =
      share == nullptr ? local_longest : static_cast<std::int32_t>(share->ranks().greatest(local_longest));
  return all < 0 ? std::nullopt : std::optional<std::int32_t>(all);
}

}  // namespace coordreq
