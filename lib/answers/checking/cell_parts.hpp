#pragma once

#include <cstdint>
#include <vector>

#include "model/outside.hpp"
#include "model/uniform_grid.hpp"
#include "numeric/rational_interval.hpp"

// What checks know of cells and indices, written for them alone: nothing that has computed a result uses it.
namespace coordreq {

/// What an expression can see of cell k: the closed cell (a point if the dimension is discrete), widened by
/// the measurement error, without what lies beyond a `stop` limit, and with what it is stretched by. In a
/// periodic dimension its copies, whole periods apart, as far as they lie in [lower, upper], those along the
/// cell first: one copy, two on the seam, and all of [lower, upper] if the cell is as wide. A copy that only
/// begins at `upper` is none, for that point is seen as `lower`. @pre 0 <= k < count
[[nodiscard]] std::vector<RationalInterval> parts_of(const GridDimension& dimension, std::int64_t k);

/// Raw indices first, ..., last, cut to 32 bits; of a ring the same cells, some turns nearer, if they are far
/// out. Of indices beyond 2^62 no more is known: what they are cut to holds them. @pre first <= last, unless
/// one is so far out
[[nodiscard]] IndexRange cut_to_range(const GridDimension& dimension, std::int64_t first, std::int64_t last);

/// The fewest cells side by side that hold both ranges. In a ring the shortest arc, of equally short ones
/// that which begins as `a` does, from there or less than a turn below; {0, count - 1} if it goes all round.
/// @pre first <= last of both
[[nodiscard]] IndexRange both_of(IndexRange a, IndexRange b, const GridDimension& dimension);

}  // namespace coordreq
