#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/row_operations.hpp"
#include "model/outside.hpp"

// How a row of cells is laid out in memory, and which levels stand beyond its ends.
namespace coordreq {

/// How a row goes on beyond its ends, where posts leave it.
struct RowEnds {
  /// unsafe: by cells of no set; safe: by cells of every set; saturate and stop: by its first cell again;
  /// periodic (both ends): by the row itself.
  Outside below = Outside::unsafe;
  Outside above = Outside::unsafe;  ///< likewise, with the last cell
};

/// The shortest offsets [first, last] along a row of n cells that have the same meaning: beyond its ends a
/// row goes on unchanged, and on a ring it comes again.
[[nodiscard]] inline IndexRange fit_window(IndexRange window, std::int64_t n, RowEnds ends) {
  if (traits(ends.below).wraps) {
    std::int64_t first = (window.first % n + n) % n;
    if (first > n / 2) first -= n;
    const std::int64_t last = first + std::min(std::int64_t{window.last} - window.first, n - 1);
    return {static_cast<std::int32_t>(first), static_cast<std::int32_t>(last)};
  }
  return {static_cast<std::int32_t>(std::clamp<std::int64_t>(window.first, -n, n)),
          static_cast<std::int32_t>(std::clamp<std::int64_t>(window.last, -n, n))};
}

/// The numbers of cells beyond each end of a row that posts can meet.
struct RowMargins {
  std::int64_t before = 0;
  std::int64_t after = 0;
};

/// One of the dimensions that rows run along.
struct RowDimension {
  std::int64_t count = 0;   ///< indices
  std::int64_t stride = 1;  ///< lanes from one index to the next
  RowMargins margins;       ///< in indices; together at most the gap that the dimension has in the rows
  RowEnds ends;
};

/// How a row is laid out: cells and gaps in *lanes*, from the slowest dimension to the fastest, whose stride
/// is 1.
struct RowShape {
  std::vector<RowDimension> dimensions;

  /// Lanes of a row, those of the gaps included.
  [[nodiscard]] std::int64_t length() const { return dimensions.front().count * dimensions.front().stride; }
  /// Lanes before and after a row that posts of its cells can meet.
  [[nodiscard]] RowMargins margins() const {
    RowMargins lanes;
    for (const RowDimension& dimension : dimensions) {
      lanes.before += dimension.margins.before * dimension.stride;
      lanes.after += dimension.margins.after * dimension.stride;
    }
    return lanes;
  }
  /// Calls `visit(lane, count)` for every run of cells along the fastest dimension.
  template <class Visit>
  void for_each_run(const Visit& visit, std::size_t k = 0, std::int64_t lane = 0) const {
    const RowDimension& dimension = dimensions[k];
    if (k + 1 == dimensions.size()) return visit(lane, dimension.count);
    for (std::int64_t i = 0; i < dimension.count; ++i)
      for_each_run(visit, k + 1, lane + i * dimension.stride);
  }
};

/// Sets the bits of the cells of a row from which `window`, offsets in dimension k of the row, reaches beyond
/// an unsafe end. Bits of gaps may be set too.
inline void mark_leaving(const RowShape& shape, std::size_t k, IndexRange window, MutableRow bits) {
  const RowDimension& dimension = shape.dimensions[k];
  const std::int64_t n = dimension.count;
  const auto mark = [&](std::int64_t first, std::int64_t last) {
    if (first >= last) return;
    // The n indices come again at the distance that the next slower dimension has.
    const std::int64_t distance = k == 0 ? shape.length() : shape.dimensions[k - 1].stride;
    for (std::int64_t lane = 0; lane < shape.length(); lane += distance)
      set_bits(bits, lane + first * dimension.stride, lane + last * dimension.stride);
  };
  if (traits(dimension.ends.below).blocks)
    mark(0, std::clamp<std::int64_t>(-std::int64_t{window.first}, 0, n));
  if (traits(dimension.ends.above).blocks) mark(n - std::clamp<std::int64_t>(window.last, 0, n), n);
}

}  // namespace coordreq
