#include "answers/invariance/safe_tubes.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "answers/invariance/safe_set.hpp"

namespace coordreq {
namespace {

using Limits = std::numeric_limits<std::int32_t>;

/// How many cells the tubes of a state go beyond the domain where it saturates.
struct Excess {
  std::int64_t below = 0;
  std::int64_t above = 0;
};

Excess find_excess(const TransitionTable& tube, const GridDimension& dimension) {
  Excess excess;
  const auto add = [&](IndexRange raw) {
    if (resolve(raw, dimension.count, dimension.below, dimension.above).blocked) return;
    if (traits(dimension.below).resets) excess.below = std::max(excess.below, -std::int64_t{raw.first});
    if (traits(dimension.above).resets) {
      excess.above = std::max(excess.above, std::int64_t{raw.last} - (dimension.count - 1));
    }
  };
  for (const IndexRange entry : tube.entries) {
    if (!tube.shift) add(entry);
    // The entry of a shift serves every index of its own.
    for (std::int64_t own = 0; tube.shift && own < dimension.count; ++own) add(moved(entry, own));
  }
  return excess;
}

/// A place that 32 bits do not hold: nobody knows how far it goes.
bool is_lost(std::int64_t excess, std::int64_t count) {
  return excess + count > Limits::max();
}

void remove_cells(CellSet& set, const UniformGrid& grid, std::size_t dimension, std::int64_t index) {
  for (std::int64_t x = 0; x < grid.cells(); ++x) {
    if (grid.index(x, dimension) == index) set.reset(x);
  }
}

}  // namespace

std::optional<CellSet> safe_beyond_limits(const ProblemSpec& spec, const Abstraction& abstraction,
                                          const CellSet& safe, ThreadTeam& team) {
  if (abstraction.tubes.empty() || spec.abstraction.safe == Membership::center) return std::nullopt;
  std::vector<GridDimension> dimensions = abstraction.grid.dimensions();
  std::vector<std::pair<std::size_t, std::int64_t>> lost;
  bool stretched = false;
  for (const std::uint32_t state : spec.safe.variables()) {
    const std::size_t i = abstraction.grid.dimension_of(state);
    GridDimension& dimension = dimensions[i];
    const Excess excess = find_excess(abstraction.tubes[i], dimension);
    dimension.stretch_below = dimension.step * Rational(static_cast<long>(excess.below));
    dimension.stretch_above = dimension.step * Rational(static_cast<long>(excess.above));
    stretched = stretched || excess.below > 0 || excess.above > 0;
    if (is_lost(excess.below, dimension.count)) lost.emplace_back(i, 0);
    if (is_lost(excess.above, dimension.count)) lost.emplace_back(i, dimension.count - 1);
  }
  if (!stretched) return std::nullopt;
  CellSet result = cells_that_satisfy(spec.safe, spec, abstraction.grid.with(std::move(dimensions)),
                                      abstraction.inputs, team);
  for (const auto& [dimension, index] : lost) remove_cells(result, abstraction.grid, dimension, index);
  // More is asked of these cells, but a sharper evaluation may have more luck with a larger box.
  for (std::size_t w = 0; w < result.words().size(); ++w) result.words()[w] &= safe.words()[w];
  return result;
}

}  // namespace coordreq
