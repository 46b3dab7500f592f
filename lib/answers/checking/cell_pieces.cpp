#include "answers/checking/cell_pieces.hpp"

#include <algorithm>

#include "base/requires.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kFarOut = std::int64_t{1} << 30;

/// An index brought into [0, count) on a ring.
std::int64_t in_ring(std::int64_t index, std::int64_t count) {
  const std::int64_t rest = index % count;
  return rest < 0 ? rest + count : rest;
}

RationalInterval within_limits(const GridDimension& dimension, std::int64_t k, RationalInterval cell) {
  const bool is_first = k == 0;
  const bool is_last = k + 1 == dimension.count;
  if (is_first) cell.lower -= dimension.extension_below;
  if (is_last) cell.upper += dimension.extension_above;
  const Rational bottom = dimension.first;
  const Rational top = dimension.point(dimension.count - 1);
  if (dimension.below == Outside::stop && cell.lower < bottom) cell.lower = bottom;
  if (dimension.above == Outside::stop && cell.upper > top) cell.upper = top;
  return cell;
}

bool goes_round(IndexRange range, std::int64_t count) {
  const bool is_lost = range.first == INT32_MIN || range.last == INT32_MAX;
  return is_lost || std::int64_t{range.last} - range.first + 1 >= count;
}

}  // namespace

std::vector<RationalInterval> pieces_of(const GridDimension& dimension, std::int64_t k) {
  REQUIRES(0 <= k && k < dimension.count);
  const Rational reach = dimension.radius() + dimension.measurement_error;
  const RationalInterval cell{.lower = dimension.point(k) - reach, .upper = dimension.point(k) + reach};
  if (!dimension.periodic()) return {within_limits(dimension, k, cell)};
  const Rational& bottom = dimension.lower;
  const Rational& top = dimension.upper;
  const Rational period = top - bottom;
  if (cell.upper - cell.lower >= period) return {{.lower = bottom, .upper = top}};
  std::vector<RationalInterval> pieces;
  // The copy that ends at or beyond `lower` for the first time, and those after it.
  for (std::int64_t turn = ceil_to_int((bottom - cell.upper) / period);; ++turn) {
    const Rational by = period * Rational(static_cast<long>(turn));
    RationalInterval copy{.lower = cell.lower + by, .upper = cell.upper + by};
    if (copy.lower >= top) break;
    copy.lower = std::max(copy.lower, bottom);
    copy.upper = std::min(copy.upper, top);
    pieces.push_back(std::move(copy));
  }
  // The part next to `upper` comes first along the cell.
  std::reverse(pieces.begin(), pieces.end());
  return pieces;
}

IndexRange cut_to_range(const GridDimension& dimension, std::int64_t first, std::int64_t last) {
  constexpr std::int64_t kUnknown = 4 * kFarOut * kFarOut;
  const bool is_known = std::min(first - 1, last) > -kUnknown && std::max(first, last + 1) < kUnknown;
  REQUIRES(first <= last || !is_known);
  if (dimension.periodic() && !is_known) return {0, static_cast<std::int32_t>(dimension.count - 1)};
  if (dimension.periodic() && (first < -kFarOut || last > kFarOut)) {
    const std::int64_t length = last - first;
    first %= dimension.count;
    last = first + length;
  }
  const auto cut = [](std::int64_t index) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(index, INT32_MIN, INT32_MAX));
  };
  return {cut(first), cut(last)};
}

IndexRange both_of(IndexRange a, IndexRange b, const GridDimension& dimension) {
  REQUIRES(a.first <= a.last && b.first <= b.last);
  if (!dimension.periodic()) return {std::min(a.first, b.first), std::max(a.last, b.last)};
  const std::int64_t count = dimension.count;
  const IndexRange all{0, static_cast<std::int32_t>(count - 1)};
  if (goes_round(a, count) || goes_round(b, count)) return all;
  const auto length_from = [count](IndexRange from, IndexRange other) {
    const std::int64_t ahead = in_ring(std::int64_t{other.first} - from.first, count);
    return std::max(std::int64_t{from.last} - from.first, ahead + (std::int64_t{other.last} - other.first)) +
           1;
  };
  const std::int64_t from_a = length_from(a, b);
  const std::int64_t from_b = length_from(b, a);
  const std::int64_t length = std::min(from_a, from_b);
  if (length >= count) return all;
  const std::int64_t back = from_a <= from_b ? 0 : in_ring(std::int64_t{a.first} - b.first, count);
  return cut_to_range(dimension, a.first - back, a.first - back + length - 1);
}

}  // namespace coordreq
