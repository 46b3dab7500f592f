#include "model/outside.hpp"

#include <algorithm>
#include <limits>

#include "base/requires.hpp"

namespace coordreq {
namespace {

using Limits = std::numeric_limits<std::int32_t>;

}  // namespace

std::int32_t saturate_index(std::int64_t index) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(index, Limits::min(), Limits::max()));
}

IndexRange moved(IndexRange raw, std::int64_t by) {
  // An index at the lower limit may be farther out, and must still say so (wrap_range).
  const auto one = [by](std::int32_t index) {
    return index == Limits::min() ? index : saturate_index(std::int64_t{index} + by);
  };
  return {one(raw.first), one(raw.last)};
}

IndexRange wrap_range(IndexRange raw, std::int64_t count) {
  REQUIRES(raw.first <= raw.last && count >= 1);
  const std::int64_t distance = std::int64_t{raw.last} - raw.first;
  const bool lost = raw.first == Limits::min() || raw.last == Limits::max();
  const std::int64_t first = (raw.first % count + count) % count;
  if (lost || distance + 1 >= count || first + distance > Limits::max()) {
    return {0, static_cast<std::int32_t>(count - 1)};
  }
  return {static_cast<std::int32_t>(first), static_cast<std::int32_t>(first + distance)};
}

ResolvedRange resolve(IndexRange raw, std::int64_t count, Outside below, Outside above) {
  REQUIRES(raw.first <= raw.last && count >= 1 && traits(below).wraps == traits(above).wraps);
  if (traits(below).wraps) return {.blocked = false, .inside = wrap_range(raw, count)};
  const auto top = static_cast<std::int32_t>(count - 1);
  const bool leaves_below = raw.first < 0;
  const bool leaves_above = raw.last > top;
  ResolvedRange result;
  result.blocked = (leaves_below && traits(below).blocks) || (leaves_above && traits(above).blocks);
  if (traits(below).clamps) {
    raw.first = std::max(raw.first, 0);
    raw.last = std::max(raw.last, 0);
  }
  if (traits(above).clamps) {
    raw.first = std::min(raw.first, top);
    raw.last = std::min(raw.last, top);
  }
  result.inside = {std::max(raw.first, 0), std::min(raw.last, top)};
  return result;
}

}  // namespace coordreq
