#include "answers/layers/best_cells.hpp"

#include <algorithm>

#include "model/outside.hpp"

namespace coordreq {
namespace {

/// Whether a side is a choice of the spec, so that a larger domain could go on beyond it.
bool is_arbitrary(const GridDimension& dimension, bool above) {
  const OutsideTraits& rule = traits(above ? dimension.above : dimension.below);
  return !dimension.discrete && dimension.count > 1 && (rule.blocks || rule.resets);
}

/// The sides that the best cells in some rows touch.
struct Touched {
  std::vector<std::int64_t> sides;  ///< [2 * dimension + above] number of cells at the side
  std::int64_t inside = 0;          ///< number of cells at no side

  void add(const UniformGrid& grid, std::int64_t cell) {
    bool is_inside = true;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const std::int64_t index = grid.index(cell, i);
      for (const bool above : {false, true}) {
        if (index != (above ? grid[i].count - 1 : 0) || !is_arbitrary(grid[i], above)) continue;
        ++sides[2 * i + (above ? 1 : 0)];
        is_inside = false;
      }
    }
    if (is_inside) ++inside;
  }
};

}  // namespace

std::vector<GridSide> sides_of_best_cells(const AnalysisContext& context, const DelayLayers& layers) {
  const auto last = static_cast<std::int64_t>(layers.sizes.size()) - 1;
  if (layers.truncated || last < 2) return {};
  const UniformGrid& grid = context.abstraction->grid;
  Touched touched{std::vector<std::int64_t>(2 * grid.size(), 0)};
  layers.layers_of.visit([&](const auto& levels) {
    const std::int64_t begin = context.share ? context.share->own().begin : 0;
    const std::int64_t end = context.share ? context.share->own().end : levels.rows();
    // A single process may stop at the first best cell that is inside.
    for (std::int64_t r = begin; r < end && (context.share || touched.inside == 0); ++r) {
      const auto* const row = levels.row(r);
      levels.shape().for_each_run([&](std::int64_t lane, std::int64_t count) {
        for (const auto* at = std::find(row + lane, row + lane + count, last); at != row + lane + count;
             at = std::find(at + 1, row + lane + count, last))
          touched.add(grid, r * grid.row_length() + (at - row));
      });
    }
  });
  if (context.share) {
    touched.sides.push_back(touched.inside);
    context.ranks->add(touched.sides);
    touched.inside = touched.sides.back();
    touched.sides.pop_back();
  }
  std::vector<GridSide> found;
  for (std::size_t s = 0; touched.inside == 0 && s < touched.sides.size(); ++s) {
    if (touched.sides[s] > 0) found.push_back({s / 2, s % 2 == 1});
  }
  return found;
}

}  // namespace coordreq
