#include "engine/find_levels.hpp"

#include <algorithm>
#include <atomic>
#include <type_traits>
#include <utility>

#include "base/fast_paths.hpp"
#include "engine/different_rows.hpp"
#include "engine/sparing_operator.hpp"

namespace coordreq {
namespace {

/// A level in fewer or more bits: a level that does not fit becomes kTop, which is not too low.
template <class Level, class Other>
Level converted(Other level) {
  if (level == LevelRows<Other>::kTop || level >= LevelRows<Level>::kTop) return LevelRows<Level>::kTop;
  return static_cast<Level>(level);
}

/// A level of nearness in more bits: as far from kTop as it was. 0 and 1 stay, which are not distances.
template <class Wide, class Narrow>
Wide raised(Narrow level) {
  if (level <= 1) return level;
  return static_cast<Wide>(LevelRows<Wide>::kTop - (LevelRows<Narrow>::kTop - level));
}

template <class Wide, class Narrow>
LevelRows<Wide> widened(const RowEngine& engine, const LevelRows<Narrow>& narrow, bool rises,
                        ThreadTeam& team) {
  LevelRows<Wide> levels = engine.make_levels<Wide>(engine.posts(), narrow.is_interned());
  put_rows(levels, team, [&](std::int64_t r, Wide* cells) {
    const Narrow* source = narrow.row(r);
    std::transform(source, source + levels.row_length(), cells,
                   rises ? raised<Wide, Narrow> : converted<Wide, Narrow>);
  });
  return levels;
}

template <class Level>
void lower_to(const LevelMap& bound, LevelRows<Level>& levels, ThreadTeam& team) {
  bound.visit([&]<class Other>(const LevelRows<Other>& other) {
    put_rows(levels, team, [&](std::int64_t r, Level* cells) {
      const Level* const row = levels.row(r);
      std::transform(row, row + levels.row_length(), other.row(r), cells,
                     [](Level level, Other least) { return std::min(level, converted<Level>(least)); });
    });
  });
}

/// Makes rows equal to their canonical rows, whose bounds are bounds of all permuted rows. The least of these
/// would be closer, but a process does not hold all of them.
template <class Level>
void copy_canonical_rows(const RowSymmetry& symmetry, LevelRows<Level>& levels, ThreadTeam& team) {
  constexpr std::int64_t kRows = 1 << 16, kRowsAtOnce = 1 << 10;
  std::vector<std::int64_t> first(kRows);  // found by all threads; rows that are interned are copied by one
  for (const RowShare::Range run : held_rows(levels.share(), levels.rows())) {
    for (std::int64_t begin = run.begin; begin < run.end; begin += kRows) {
      const std::int64_t count = std::min(kRows, run.end - begin);
      team.for_each(count, kRowsAtOnce, [&](ThreadTeam::Range range, int) {
        for (std::int64_t k = range.begin; k < range.end; ++k)
          first[static_cast<std::size_t>(k)] = symmetry.canonical_of(begin + k);
      });
      team.for_each(count, levels.is_interned() ? count : kRowsAtOnce, [&](ThreadTeam::Range range, int) {
        for (std::int64_t k = range.begin; k < range.end; ++k) {
          if (const std::int64_t row = first[static_cast<std::size_t>(k)]; row != begin + k)
            static_cast<void>(levels.copy_row(row, begin + k));
        }
      });
    }
  }
}

/// Whether some cell of any process has this level. Levels in gaps do not count.
template <class Level>
bool has_level(const LevelRows<Level>& levels, Level level, ThreadTeam& team) {
  std::atomic<bool> found = false;
  const DifferentRows<Level> rows(levels);
  team.for_each(rows.size(), 256, [&](ThreadTeam::Range range, int) {
    rows.for_each(range, [&](const Level* row, std::int64_t) {
      levels.shape().for_each_run([&](std::int64_t lane, std::int64_t count) {
        if (!found && std::find(row + lane, row + lane + count, level) != row + lane + count) found = true;
      });
    });
  });
  return sum_of_all(levels.share(), found ? 1 : 0) > 0;
}

/// False if a cell has the last finite level of the width: then cells at kTop may have finite levels beyond
/// it.
template <class Level>
bool is_enough(const LevelRows<Level>& levels, bool rises, std::int64_t limit, ThreadTeam& team) {
  constexpr Level kTop = LevelRows<Level>::kTop;
  if (rises) return !has_level(levels, Level{2}, team);
  return (limit >= 0 && limit < kTop - 1) || !has_level(levels, static_cast<Level>(kTop - 1), team);
}

/// The limit in a width. Levels above it count as kTop, which is not too low, so that the wave can go on from
/// them with more bits.
template <class Level>
Level clipped(std::int64_t limit) {
  constexpr std::int64_t kMost = std::int64_t{LevelRows<Level>::kTop} - 1;
  return static_cast<Level>(limit < 0 ? kMost : std::min(limit, kMost));
}

/// Finds the levels of one problem, with as many bits a cell as they need.
class LevelFinder {
 public:
  LevelFinder(const RowEngine& engine, const RowHull& hull, const LevelProblem& problem,
              const WaveWatch& watch, ThreadTeam& team, WaveCounts& counts)
      : engine_(engine), hull_(hull), problem_(problem), watch_(watch), team_(team), counts_(counts) {}

  LevelMap from_start() {
    return fast_paths().narrow_levels ? from_start_of<std::uint8_t>() : from_start_of<std::uint32_t>();
  }
  template <class Level>
  LevelMap from(LevelRows<Level> levels) {
    const auto op = make_operator<Level>();
    // The sweeps of all widths are numbered through.
    const std::int64_t before = counts_.sweeps;
    const WaveWatch watch{.step = watch_.step ? [&, before](WaveStep step) {
      step.sweep += before;
      watch_.step(step);
    } : std::function<void(const WaveStep&)>()};
    const RowSymmetry* const symmetry = problem_.equal.symmetry;
    if (symmetry != nullptr) copy_canonical_rows(*symmetry, levels, team_);
    counts_.add(
        run_wave(levels, engine_, hull_, clipped<Level>(problem_.limit), *op, watch, team_, problem_.equal));
    if constexpr (sizeof(Level) < sizeof(std::uint32_t)) {
      if (!is_enough(levels, op->rises(), problem_.limit, team_))
        return from(widened_and_bounded(std::move(levels), op->rises()));
    }
    return LevelMap(std::move(levels));
  }

 private:
  template <class Level>
  LevelMap from_start_of() {
    auto levels = engine_.make_levels<Level>(*problem_.start, team_, problem_.equal.tiles != nullptr);
    for (const LevelMap* bound : problem_.bounds) lower_to(*bound, levels, team_);
    return from(std::move(levels));
  }

  template <class Level>
  auto widened_and_bounded(LevelRows<Level> levels, bool rises) {
    using Wide = std::conditional_t<sizeof(Level) == 1, std::uint16_t, std::uint32_t>;
    LevelRows<Wide> wide = widened<Wide>(engine_, levels, rises, team_);
    levels = {};
    for (const LevelMap* bound : problem_.bounds) lower_to(*bound, wide, team_);
    return wide;
  }

  template <class Level>
  std::unique_ptr<RowOperator<Level>> make_operator() const {
    if (problem_.spared == nullptr) return make_whole_operator<Level>();
    return std::make_unique<SparingOperator<Level>>(make_whole_operator<Level>(), *problem_.spared,
                                                    team_.size());
  }

  template <class Level>
  std::unique_ptr<RowOperator<Level>> make_whole_operator() const {
    if constexpr (sizeof(Level) == 1) return problem_.make8();
    if constexpr (sizeof(Level) == 2) return problem_.make16();
    if constexpr (sizeof(Level) == 4) return problem_.make32();
  }

  const RowEngine& engine_;
  const RowHull& hull_;
  const LevelProblem& problem_;
  const WaveWatch& watch_;
  ThreadTeam& team_;
  WaveCounts& counts_;
};

}  // namespace

LevelMap find_levels(const RowEngine& engine, const RowHull& hull, const LevelProblem& problem,
                     const WaveWatch& watch, ThreadTeam& team, WaveCounts& counts) {
  LevelFinder finder(engine, hull, problem, watch, team, counts);
  if (watch.resumed == nullptr) return finder.from_start();
  LevelMap resumed = std::move(*watch.resumed);
  if (auto* levels = resumed.get_if<std::uint8_t>()) return finder.from(std::move(*levels));
  if (auto* levels = resumed.get_if<std::uint16_t>()) return finder.from(std::move(*levels));
  return finder.from(std::move(*resumed.get_if<std::uint32_t>()));
}

}  // namespace coordreq
