#pragma once

#include <span>
#include <vector>

#include "engine/row_shape.hpp"
#include "model/model.hpp"
#include "model/row_sample.hpp"
#include "reach/abstraction.hpp"

namespace coordreq {

/// The grid of an abstraction with rows along as many of the last dimensions as possible: each of them moves
/// by offsets that depend on none of them, and no other dimension depends on them. Integrators (x' = x + u)
/// do.
///
/// Why: a window of offsets in each dimension is then a window of lanes of the row, so that work done once a
/// row (to find its groups of actions, and the rows that they lead to) is done once for a plane of cells or
/// more: on the gridworld of the paper 41 times less often. Rows stay small enough for first-level caches,
/// and at least one dimension is left across them. The switch is FastPaths::joined_rows.
/// @param most dimensions along rows; kMostJoinedLanes is a limit beside it
/// @returns the grid as it is if no dimensions can be joined, or if there are tubes
[[nodiscard]] UniformGrid join_rows(const Abstraction& abstraction, std::size_t most = SIZE_MAX);
/// join_rows() as far as it is known before there are tables; for estimates. @param offsets [state] of posts
[[nodiscard]] UniformGrid join_rows(const Model& model, const std::vector<IndexRange>& offsets);

/// How far windows along a dimension reach beyond its ends, either way.
[[nodiscard]] RowMargins window_margins(std::span<const IndexRange> windows, const GridDimension& dimension);

}  // namespace coordreq
