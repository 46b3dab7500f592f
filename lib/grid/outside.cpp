#include "grid/outside.hpp"

#include <algorithm>
#include <limits>

namespace coordreq {

std::int32_t saturate_index(std::int64_t index) {
  using Limits = std::numeric_limits<std::int32_t>;
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(index, Limits::min(), Limits::max()));
}

ResolvedRange resolve(IndexRange raw, std::int64_t count, Outside below, Outside above) {
  const auto top = static_cast<std::int32_t>(count - 1);
  const bool leaves_below = raw.first < 0;
  const bool leaves_above = raw.last > top;
  ResolvedRange result;
  result.blocked = (leaves_below && below == Outside::unsafe) || (leaves_above && above == Outside::unsafe);
  if (below == Outside::saturate) {
    raw.first = std::max(raw.first, 0);
    raw.last = std::max(raw.last, 0);
  }
  if (above == Outside::saturate) {
    raw.first = std::min(raw.first, top);
    raw.last = std::min(raw.last, top);
  }
  result.inside = {std::max(raw.first, 0), std::min(raw.last, top)};
  return result;
}

}  // namespace coordreq
