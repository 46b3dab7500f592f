#include "model/pieces.hpp"

#include <algorithm>

#include "base/requires.hpp"

namespace coordreq {

IndexRange merge_ranges(IndexRange a, IndexRange b, const GridDimension& target) {
  REQUIRES(a.first <= a.last && b.first <= b.last);
  if (!target.periodic()) return {std::min(a.first, b.first), std::max(a.last, b.last)};
  const std::int64_t count = target.count;
  const IndexRange whole{0, static_cast<std::int32_t>(count - 1)};
  const IndexRange arc_a = wrap_range(a, count);
  const IndexRange arc_b = wrap_range(b, count);
  if (arc_a == whole || arc_b == whole) return whole;
  // From the beginning of either one to the farther end, the other beginning at most a period later.
  const auto from = [&](const IndexRange& one, const IndexRange& other) {
    const std::int64_t shift = other.first < one.first ? count : 0;
    return std::max<std::int64_t>(one.last, other.last + shift) - one.first;
  };
  const std::int64_t from_a = from(arc_a, arc_b);
  const std::int64_t from_b = from(arc_b, arc_a);
  if (std::min(from_a, from_b) + 1 >= count) return whole;
  const std::int64_t before = from_a <= from_b ? 0 : (arc_a.first - arc_b.first + count) % count;
  const std::int64_t first = a.first - before;
  return {saturate_index(first), saturate_index(first + std::min(from_a, from_b))};
}

IndexRange raw_range(const GridDimension& dimension, std::int64_t first, std::int64_t last) {
  constexpr std::int64_t kFar = std::int64_t{1} << 30;
  constexpr std::int64_t kUnknown = std::int64_t{1} << 62;
  const bool known = first > -kUnknown && std::max(first, last + 1) < kUnknown;
  const bool far = first < -kFar || last > kFar;
  // Beyond 64 bits its position on the ring is unknown.
  if (dimension.periodic() && !known) return {0, static_cast<std::int32_t>(dimension.count - 1)};
  if (dimension.periodic() && far) {
    const std::int64_t turns = first / dimension.count * dimension.count;
    first -= turns;
    last -= turns;
  }
  return {saturate_index(first), saturate_index(last)};
}

}  // namespace coordreq
