#include "answers/invariance/safe_tubes.hpp"

#include <algorithm>
#include <functional>
#include <limits>

#include "answers/invariance/safe_set.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Limits = std::numeric_limits<std::int32_t>;

/// Number of cells by which the tubes of a state go beyond the domain where it saturates.
struct Excess {
  std::int64_t below = 0;
  std::int64_t above = 0;
};

Excess find_excess(const TransitionTable& tube, const GridDimension& dimension, Ranks* ranks) {
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
    // An entry of a shift serves every index of the state itself.
    for (std::int64_t index = 0; tube.shift && index < dimension.count; ++index) add(moved(entry, index));
  }
  if (ranks == nullptr) return excess;
  return {ranks->greatest(excess.below), ranks->greatest(excess.above)};
}

/// Whether an end of a tube is an index that was cut to 32 bits, so that it is not known how far it goes.
bool is_lost(std::int64_t excess, std::int64_t count) {
  return excess + count > Limits::max();
}

void remove_cells(CellSet& set, const UniformGrid& grid, RowShare::Range rows, std::size_t dimension,
                  std::int64_t index) {
  for (std::int64_t x = rows.begin * grid.row_length(); x < rows.end * grid.row_length(); ++x) {
    if (grid.index(x, dimension) == index) set.reset(x);
  }
}

}  // namespace

std::optional<TubeLimits> find_tube_limits(const ProblemSpec& spec, const Abstraction& abstraction,
                                           Ranks* ranks) {
  if (abstraction.tubes.empty() || spec.abstraction.safe == Membership::center) return std::nullopt;
  TubeLimits limits{.dimensions = abstraction.grid.dimensions(), .unknown = {}};
  bool stretched = false;
  for (const std::uint32_t state : spec.safe.variables()) {
    const std::size_t i = abstraction.grid.dimension_of(state);
    GridDimension& dimension = limits.dimensions[i];
    const Excess excess = find_excess(abstraction.tubes[i], dimension, ranks);
    dimension.extension_below = dimension.step * Rational(static_cast<long>(excess.below));
    dimension.extension_above = dimension.step * Rational(static_cast<long>(excess.above));
    stretched = stretched || excess.below > 0 || excess.above > 0;
    if (is_lost(excess.below, dimension.count)) limits.unknown.emplace_back(i, 0);
    if (is_lost(excess.above, dimension.count)) limits.unknown.emplace_back(i, dimension.count - 1);
  }
  if (!stretched) return std::nullopt;
  return limits;
}

void add_safe_beyond(const TubeLimits& limits, const ProblemSpec& spec, const Abstraction& abstraction,
                     const CellSet& safe, const std::vector<RowShare::Range>& runs, ThreadTeam& team,
                     CellSet& beyond) {
  const UniformGrid& grid = abstraction.grid;
  add_cells_that_satisfy(spec.safe, spec, grid.with(limits.dimensions), abstraction.inputs, runs, team,
                         beyond);
  for (const RowShare::Range run : runs) {
    for (const auto& [dimension, index] : limits.unknown) remove_cells(beyond, grid, run, dimension, index);
    // The condition is evaluated on larger boxes than for S, but evaluation is not monotone: cells outside S
    // are taken out.
    for (std::int64_t row = run.begin; row < run.end; ++row)
      std::ranges::transform(beyond.row(row), safe.row(row), beyond.row(row).begin(), std::bit_and<>());
  }
}

std::optional<CellSet> safe_beyond_limits(const ProblemSpec& spec, const Abstraction& abstraction,
                                          const CellSet& safe, ThreadTeam& team) {
  const std::optional<TubeLimits> limits = find_tube_limits(spec, abstraction);
  if (!limits) return std::nullopt;
  CellSet result(safe.rows(), safe.row_length());
  add_safe_beyond(*limits, spec, abstraction, safe, {{0, safe.rows()}}, team, result);
  return result;
}

}  // namespace coordreq
