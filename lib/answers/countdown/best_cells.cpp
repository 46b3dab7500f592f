#include "answers/countdown/best_cells.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "model/outside.hpp"

namespace coordreq {
namespace {

/// Whether a side is a choice of the spec, so that a larger domain could go on beyond it.
bool is_arbitrary(const GridDimension& dimension, bool above) {
  const OutsideTraits& rule = traits(above ? dimension.above : dimension.below);
  return !dimension.discrete && dimension.count > 1 && (rule.blocks || rule.resets);
}

/// The sides that some of the best cells touch.
struct Touched {
  explicit Touched(const UniformGrid& grid) : cells(2 * grid.size() + 1, 0) {}

  void add(const UniformGrid& grid, std::int64_t cell) {
    bool is_inside = true;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const std::int64_t index = grid.index(cell, i);
      for (const bool above : {false, true}) {
        if (index != (above ? grid[i].count - 1 : 0) || !is_arbitrary(grid[i], above)) continue;
        ++cells[2 * i + (above ? 1 : 0)];
        is_inside = false;
      }
    }
    if (is_inside) ++cells.back();
  }
  [[nodiscard]] bool is_any_inside() const { return cells.back() > 0; }
  /// None if some cell is at no side.
  [[nodiscard]] std::vector<GridSide> sides() const {
    std::vector<GridSide> result;
    for (std::size_t s = 0; !is_any_inside() && s + 1 < cells.size(); ++s) {
      if (cells[s] > 0) result.push_back({s / 2, s % 2 == 1});
    }
    return result;
  }

  std::vector<std::int64_t> cells;  ///< [2 * dimension + above] at that side, and last of all at none
};

/// The level of the cells with the longest finite delay; nothing if there is no finite delay above 0, or if
/// none is known to be the longest.
std::optional<std::int64_t> finite_level(const DelayLayers& layers) {
  const auto last = static_cast<std::int64_t>(layers.sizes.size()) - 1;
  if (layers.truncated || last < 2) return std::nullopt;
  return last;
}

/// The same, but LevelMap::kTop where no finite delay is above 0 and some are unbounded.
std::optional<std::int64_t> best_level(const DelayLayers& layers) {
  if (!layers.truncated && layers.sizes.size() <= 2 && layers.sizes.back() > 0) return LevelMap::kTop;
  return finite_level(layers);
}

/// The first of some levels that is this one, or their end.
template <class Level>
const Level* find_level(const Level* begin, const Level* end, std::int64_t level) {
  if constexpr (sizeof(Level) == 1) {
    const void* const match =
        std::memchr(begin, static_cast<int>(level), static_cast<std::size_t>(end - begin));
    return match == nullptr ? end : static_cast<const Level*>(match);
  } else {
    return std::find(begin, end, static_cast<Level>(level));
  }
}

/// Calls `visit(first, end)` for each run of cells in a row that has a level: where it stands first, and
/// where the run ends. The row is looked through as a whole first: most have none, and levels in gaps do no
/// harm.
template <class Level, class Visit>
void for_each_run_with(std::int64_t level, const LevelRows<Level>& levels, const Level* row,
                       const Visit& visit) {
  const Level* const last = row + levels.row_length();
  if (find_level(row, last, level) == last) return;
  levels.shape().for_each_run([&](std::int64_t lane, std::int64_t count) {
    const Level* const end = row + lane + count;
    if (const Level* const first = find_level(row + lane, end, level); first != end) visit(first, end);
  });
}

/// Numbers of cells in the order of the spec.
class SpecNumbers {
 public:
  explicit SpecNumbers(const UniformGrid& grid) : grid_(grid), strides_(grid.size()) {
    std::int64_t stride = 1;
    for (std::size_t state = grid.size(); state-- > 0;) {
      strides_[grid.dimension_of(state)] = stride;
      stride *= grid[grid.dimension_of(state)].count;
    }
  }

  [[nodiscard]] std::int64_t of(std::int64_t cell) const {
    std::int64_t number = 0;
    for (std::size_t i = 0; i < grid_.size(); ++i) number += grid_.index(cell, i) * strides_[i];
    return number;
  }
  [[nodiscard]] std::int64_t index(std::int64_t number, std::size_t i) const {
    return number / strides_[i] % grid_[i].count;
  }

 private:
  const UniformGrid& grid_;
  std::vector<std::int64_t> strides_;  ///< [dimension]
};

/// What one thread has found of the cells with a level.
struct BestCells {
  std::int64_t first =
      std::numeric_limits<std::int64_t>::max();  ///< the least number, in the order of the spec
  Touched touched;                               ///< if no cell inside is known yet
};

/// @param run_end of a run of cells in row r that has the level, first at `first`
template <class Level>
void add_run(const UniformGrid& grid, const SpecNumbers& numbers, std::int64_t level, std::int64_t r,
             const Level* row, const Level* first, const Level* run_end, BestCells& best) {
  const auto cell = [&](const Level* at) { return r * grid.row_length() + (at - row); };
  // Along a run numbers rise, so that the first cell of a run is enough.
  best.first = std::min(best.first, numbers.of(cell(first)));
  if (best.touched.is_any_inside()) return;  // that settles it
  // Those between the ends of a run touch the same sides: one of them is enough, the first or the second.
  for (const Level* const at : {first, find_level(first + 1, run_end, level), run_end - 1}) {
    if (at != run_end && *at == static_cast<Level>(level)) best.touched.add(grid, cell(at));
  }
}

/// Of all threads and processes. Together.
BestCells find_cells(const AnalysisContext& context, const DelayLayers& layers, std::int64_t level,
                     ThreadTeam& team) {
  constexpr std::int64_t kGrain = 1024;
  const UniformGrid& grid = context.abstraction->grid;
  const SpecNumbers numbers(grid);
  BestCells all{.touched = Touched(grid)};
  std::vector<BestCells> found(static_cast<std::size_t>(team.size()), all);
  layers.layers_of.visit([&](const auto& levels) {
    for_each_local_row(team, context.shared_rows(), levels.rows(), kGrain,
                       [&](ThreadTeam::Range range, int worker) {
                         BestCells& best = found[static_cast<std::size_t>(worker)];
                         for (std::int64_t r = range.begin; r < range.end; ++r) {
                           const auto* const row = levels.row(r);
                           for_each_run_with(level, levels, row, [&](const auto* first, const auto* run_end) {
                             add_run(grid, numbers, level, r, row, first, run_end, best);
                           });
                         }
                       });
  });
  for (const BestCells& best : found) {
    all.first = std::min(all.first, best.first);
    std::ranges::transform(all.touched.cells, best.touched.cells, all.touched.cells.begin(), std::plus());
  }
  if (context.share) {
    all.first = -context.ranks->greatest(-all.first);
    context.ranks->add(all.touched.cells);
  }
  return all;
}

}  // namespace

void find_best_cells(const AnalysisContext& context, ThreadTeam& team, DelayLayers& layers) {
  const std::optional<std::int64_t> level = best_level(layers);
  if (!level) return;
  const BestCells best = find_cells(context, layers, *level, team);
  layers.best_cell = best.first;
  if (*level != LevelMap::kTop) layers.best_sides = best.touched.sides();
}

Json best_state_json(const AnalysisContext& context, const DelayLayers& layers) {
  if (!layers.best_cell) return {};
  const UniformGrid& grid = context.abstraction->grid;
  const SpecNumbers numbers(grid);
  Json json = Json::object();
  for (std::size_t state = 0; state < grid.size(); ++state) {
    const std::size_t i = grid.dimension_of(state);
    json[grid[i].name] = nearest_double(grid[i].point(numbers.index(*layers.best_cell, i)));
  }
  return json;
}

}  // namespace coordreq
