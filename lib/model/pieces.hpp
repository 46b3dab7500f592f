#pragma once

#include <cstdint>
#include <vector>

#include "model/outside.hpp"
#include "model/uniform_grid.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// The smallest raw range that covers both; in a periodic dimension the shortest arc that does so modulo
/// count, beginning like `a` or before, or {0, count - 1}. @pre first <= last of both
[[nodiscard]] IndexRange merge_ranges(IndexRange a, IndexRange b, const GridDimension& target);

/// Raw indices first, ..., last of a dimension in 32 bits: saturated, but on a ring near ones where these are
/// far.
[[nodiscard]] IndexRange raw_range(const GridDimension& dimension, std::int64_t first, std::int64_t last);

}  // namespace coordreq
