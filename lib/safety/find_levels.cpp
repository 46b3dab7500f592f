#include "safety/find_levels.hpp"

#include <algorithm>

#include "safety/set_levels.hpp"

namespace coordreq {
namespace {

/// A level in fewer or more bits: what does not fit is kTop, which is not too low.
template <class Level, class Other>
Level converted(Other level) {
  if (level == LevelRows<Other>::kTop || level >= LevelRows<Level>::kTop) return LevelRows<Level>::kTop;
  return static_cast<Level>(level);
}

template <class Wide, class Narrow>
LevelRows<Wide> widened(const RowEngine& engine, const LevelRows<Narrow>& narrow) {
  LevelRows<Wide> levels = engine.make_levels<Wide>(engine.posts());
  for (std::int64_t r = 0; r < levels.rows(); ++r) {
    const Narrow* source = narrow.row(r);
    std::transform(source, source + levels.row_length(), levels.row(r), converted<Wide, Narrow>);
    levels.close(r);
  }
  return levels;
}

template <class Level>
void lower_to(const LevelMap& bound, LevelRows<Level>& levels, ThreadTeam& team) {
  bound.visit([&]<class Other>(const LevelRows<Other>& other) {
    team.for_each(levels.rows(), 256, [&](ThreadTeam::Range range, int) {
      for (std::int64_t r = range.begin; r < range.end; ++r) {
        std::transform(levels.row(r), levels.row(r) + levels.row_length(), other.row(r), levels.row(r),
                       [](Level own, Other least) { return std::min(own, converted<Level>(least)); });
        levels.close(r);
      }
    });
  });
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
  // What is settled at the bounds may not be so at levels that have sunk below them.
  const std::vector<std::uint8_t> nothing;
  const auto run = [&](auto& levels, const auto& make, const std::vector<std::uint8_t>& settled) {
    using Level = std::remove_cvref_t<decltype(*levels.row(0))>;
    for (const LevelMap* bound : problem.bounds) lower_to(*bound, levels, team);
    const auto op = make();
    counts.add(run_wave(levels, engine, hull, clipped<Level>(problem.limit), settled, *op, swept, team));
  };
  auto levels = top_levels<std::uint8_t>(engine, *problem.start, team);
  run(levels, problem.make8, problem.settled == nullptr ? nothing : *problem.settled);
  if (is_enough(levels, problem.limit)) return LevelMap(std::move(levels));
  auto wider = widened<std::uint16_t>(engine, levels);
  levels = {};
  run(wider, problem.make16, nothing);
  if (is_enough(wider, problem.limit)) return LevelMap(std::move(wider));
  auto widest = widened<std::uint32_t>(engine, wider);
  wider = {};
  run(widest, problem.make32, nothing);
  return LevelMap(std::move(widest));
}

}  // namespace coordreq
