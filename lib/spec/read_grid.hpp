#pragma once

#include "spec/scope.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// A dimension as written and the grid points that follow from it.
struct GridReading {
  Rational lower;
  Rational upper;
  GridSpec grid;
};

/// The kind of a grid: single points, or cells around its points. Cells are as wide as the step.
enum class GridOf : std::uint8_t { points, cells, periodic_cells };

/// Reads lower, upper and step or count (contract, section 1, "Grid").
/// With `step`: {origin + k*step : k integer} inside [lower, upper], both ends included. With `count`: that
/// many points, evenly from lower to upper, both included; upper left out if periodic. A single point is
/// lower = upper, and its step 1; for cells that says too little.
/// @throws SpecError if there is no grid point, step <= 0, lower > upper, a periodic dimension has no count,
///   or points lie closer than doubles can tell apart; LimitError beyond 2^31 - 2 points
[[nodiscard]] GridReading read_grid(const Scope& scope, const JsonDocument::Node& object, GridOf kind);

}  // namespace coordreq
