#pragma once

#include <span>
#include <vector>

#include "engine/row_shape.hpp"
#include "model/model.hpp"
#include "model/row_sample.hpp"
#include "reach/abstraction.hpp"

namespace coordreq {

/// The grid of an abstraction with rows along as many of the last dimensions as can be: each of them moves by
/// offsets that depend on none of them, and none of the others depends on them. So do integrators (x' = x +
/// u).
///
/// A window of offsets in each dimension is then one of lanes of the row, and what is done once a row (which
/// actions there are, which rows they lead to) is done once for a whole plane of cells: on the gridworld of
/// the paper 41 times less often. Rows stay small enough for the first-level caches, and one dimension at
/// least is left across them.
/// @param most dimensions to take together, kMostJoinedLanes apart
/// @returns the grid as it is if nothing can be joined, or if there are tubes
[[nodiscard]] UniformGrid join_rows(const Abstraction& abstraction, std::size_t most = SIZE_MAX);
/// The same as far as it can be told before there are tables; for estimates. @param offsets by state
[[nodiscard]] UniformGrid join_rows(const Model& model, const std::vector<IndexRange>& offsets);

/// As far as windows along a dimension reach beyond its ends, either way.
[[nodiscard]] RowMargins window_margins(std::span<const IndexRange> windows, const GridDimension& dimension);

}  // namespace coordreq
