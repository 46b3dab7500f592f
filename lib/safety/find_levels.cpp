#include "safety/find_levels.hpp"

#include <algorithm>

#include "safety/set_levels.hpp"

namespace coordreq {
namespace {

template <class Level>
LevelRows<Level> top_levels(const RowEngine& engine, const CellSet& start, ThreadTeam& team) {
  LevelRows<Level> levels = engine.make_levels<Level>(engine.posts());
  team.for_each(levels.rows(), 256,
                [&](ThreadTeam::Range range, int) { set_levels(start, range.begin, range.end, levels); });
  return levels;
}

template <class Wide, class Narrow>
LevelRows<Wide> widened(const RowEngine& engine, const LevelRows<Narrow>& narrow) {
  LevelRows<Wide> levels = engine.make_levels<Wide>(engine.posts());
  for (std::int64_t r = 0; r < levels.rows(); ++r) {
    const Narrow* source = narrow.row(r);
    std::transform(source, source + levels.row_length(), levels.row(r), [](Narrow level) {
      return level == LevelRows<Narrow>::kTop ? LevelRows<Wide>::kTop : Wide{level};
    });
    levels.close(r);
  }
  return levels;
}

/// True if a cell has the greatest finite level of the width: the ones before it may need more.
template <class Level>
bool is_full(const LevelRows<Level>& levels) {
  for (std::int64_t r = 0; r < levels.rows(); ++r) {
    const Level* row = levels.row(r);
    if (std::find(row, row + levels.row_length(), LevelRows<Level>::kTop - 1) != row + levels.row_length()) {
      return true;
    }
  }
  return false;
}

template <class Level>
bool is_enough(const LevelRows<Level>& levels, std::int64_t limit) {
  return (limit >= 0 && limit < LevelRows<Level>::kTop - 1) || !is_full(levels);
}

/// Above the limit of the width in use levels count as kTop, which is not too low: the wave can go on from
/// there with more bits.
template <class Level>
Level clipped(std::int64_t limit) {
  constexpr std::int64_t kMost = std::int64_t{LevelRows<Level>::kTop} - 1;
  return static_cast<Level>(limit < 0 ? kMost : std::min(limit, kMost));
}

}  // namespace

LevelMap find_levels(const RowEngine& engine, const RowHull& hull, const LevelProblem& problem,
                     const std::function<void(std::int64_t, std::int64_t)>& swept, ThreadTeam& team,
                     WaveCounts& counts) {
  const auto run = [&](auto& levels, const auto& make) {
    using Level = std::remove_cvref_t<decltype(*levels.row(0))>;
    const auto op = make();
    counts.add(run_wave(levels, engine, hull, clipped<Level>(problem.limit), *op, swept, team));
  };
  auto levels = top_levels<std::uint8_t>(engine, *problem.start, team);
  run(levels, problem.make8);
  if (is_enough(levels, problem.limit)) return LevelMap(std::move(levels));
  auto wider = widened<std::uint16_t>(engine, levels);
  levels = {};
  run(wider, problem.make16);
  if (is_enough(wider, problem.limit)) return LevelMap(std::move(wider));
  auto widest = widened<std::uint32_t>(engine, wider);
  wider = {};
  run(widest, problem.make32);
  return LevelMap(std::move(widest));
}

}  // namespace coordreq
