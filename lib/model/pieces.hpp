#pragma once

#include <cstdint>
#include <vector>

#include "model/outside.hpp"
#include "model/uniform_grid.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// A closed interval of values that an expression can see.
struct Piece {
  Rational lower;
  Rational upper;
  [[nodiscard]] bool operator==(const Piece&) const = default;
};

/// Where the true state can be while cell k is measured: the closed cell (the point of a discrete dimension)
/// widened by the measurement error on both sides, as one piece. Beyond a `stop` limit there is no state, so
/// that half of the boundary cell does not count; a stretched boundary cell is as long as it is stretched.
///
/// In a periodic dimension it is cut at the seam into representatives in [lower, upper), in the order along
/// the cell: at most two pieces, or [lower, upper] if it is as wide as the period. A cell that ends at
/// `upper` has the piece {lower} too, since that is how expressions see the point on the seam. A piece that
/// ends at `upper` includes it, although no state has this value: its limit counts. REQUIRES 0 <= k < count.
[[nodiscard]] std::vector<Piece> pieces(const GridDimension& dimension, std::int64_t k);

/// The smallest raw range that covers both; in a periodic dimension the shortest arc that does so modulo
/// count, beginning like `a` or before, or {0, count - 1}. REQUIRES: first <= last of both.
[[nodiscard]] IndexRange merge_ranges(IndexRange a, IndexRange b, const GridDimension& target);

/// Raw indices first, ..., last of a dimension in 32 bits: saturated, but on a ring near ones where these are
/// far.
[[nodiscard]] IndexRange raw_range(const GridDimension& dimension, std::int64_t first, std::int64_t last);

}  // namespace coordreq
