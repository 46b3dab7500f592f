#pragma once

#include <algorithm>
#include <cstdint>

#include "engine/row_operations.hpp"
#include "model/outside.hpp"

namespace coordreq {

/// The offsets [first, last] along a row of n cells, as short as they can be with the same meaning: beyond
/// its ends a row looks the same for ever, and on a ring it comes again.
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

}  // namespace coordreq
