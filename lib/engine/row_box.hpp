#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/row_engine.hpp"

namespace coordreq {

/// Calls `visit(row number)` for a box of rows: `ranges` in the dimensions from `first` on, as in
/// ResolvedRange, index 0 in those it does not name. On a ring indices beyond the last begin anew.
/// @param counter scratch memory
template <class Visit>
void for_each_row(const RowEngine& engine, std::size_t first, std::span<const IndexRange> ranges,
                  std::vector<std::int64_t>& counter, const Visit& visit) {
  const std::size_t size = ranges.size();
  counter.resize(size);
  std::int64_t row = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (ranges[i].first > ranges[i].last) return;
    counter[i] = ranges[i].first;
    row += counter[i] * engine.row_stride(first + i);
  }
  for (;;) {
    visit(row);
    std::size_t i = size;
    for (;;) {
      if (i == 0) return;
      --i;
      const std::int64_t stride = engine.row_stride(first + i);
      const std::int64_t count = engine.grid()[first + i].count;
      if (++counter[i] <= ranges[i].last) {
        row += counter[i] == count ? stride * (1 - count) : stride;
        break;
      }
      const std::int64_t last = ranges[i].last < count ? ranges[i].last : ranges[i].last - count;
      row -= (last - ranges[i].first) * stride;
      counter[i] = ranges[i].first;
    }
  }
}

}  // namespace coordreq
