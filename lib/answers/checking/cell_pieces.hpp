#pragma once

#include <cstdint>
#include <vector>

#include "model/outside.hpp"
#include "model/uniform_grid.hpp"
#include "numeric/rational_interval.hpp"

// Cells and indices for checks alone: no code that has computed a result uses these functions.
namespace coordreq {

/// The values that an expression can have in cell k: the closed cell (a point if the dimension is discrete),
/// widened by the measurement error and by its extension, and cut off at a `stop` limit. In a periodic
/// dimension its copies, whole periods apart, as far as they lie in [lower, upper], those along the cell
/// first: one copy, two on the seam, and all of [lower, upper] if the cell is as wide. A copy that begins at
/// `upper` does not count, for that point is `lower`. @pre 0 <= k < count
[[nodiscard]] std::vector<RationalInterval> pieces_of(const GridDimension& dimension, std::int64_t k);

/// Raw indices first, ..., last, cut to 32 bits; on a ring, if they are far out, the same cells some turns
/// nearer. Indices beyond 2^62 are not known exactly: the range that they are cut to holds them. @pre first
/// <= last, unless one is beyond 2^62
[[nodiscard]] IndexRange cut_to_range(const GridDimension& dimension, std::int64_t first, std::int64_t last);

/// The fewest cells side by side that hold both ranges. On a ring the shortest arc, of equally short ones the
/// arc that begins as `a` does, from there or less than a turn below; {0, count - 1} if it goes all round.
/// @pre first <= last of both
[[nodiscard]] IndexRange both_of(IndexRange a, IndexRange b, const GridDimension& dimension);

}  // namespace coordreq
