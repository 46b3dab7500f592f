#include "model/pieces.hpp"

#include <algorithm>

namespace coordreq {
namespace {

Rational rounded_down(const Rational& q) {
  mpz_class result;
  mpz_fdiv_q(result.get_mpz_t(), q.get_num_mpz_t(), q.get_den_mpz_t());
  return Rational(result);
}

/// The limits of `stop` are the first and the last grid point, so something is always left.
Piece line_piece(const GridDimension& dimension, std::int64_t k, const Rational& reach) {
  Piece piece{dimension.point(k) - reach, dimension.point(k) + reach};
  if (k == 0) piece.lower -= dimension.stretch_below;
  if (k == dimension.count - 1) piece.upper += dimension.stretch_above;
  if (traits(dimension.below).stops) piece.lower = std::max(piece.lower, dimension.first);
  if (traits(dimension.above).stops) {
    piece.upper = std::min(piece.upper, dimension.point(dimension.count - 1));
  }
  return piece;
}

}  // namespace

std::vector<Piece> pieces(const GridDimension& dimension, std::int64_t k) {
  const Rational reach = dimension.radius() + dimension.measurement_error;
  if (!dimension.periodic()) return {line_piece(dimension, k, reach)};
  Rational low = dimension.point(k) - reach;
  const Rational period = dimension.upper - dimension.lower;
  if (2 * reach >= period) return {{dimension.lower, dimension.upper}};
  low -= period * rounded_down((low - dimension.lower) / period);
  const Rational high = low + 2 * reach;
  if (high < dimension.upper) return {{low, high}};
  return {{low, dimension.upper}, {dimension.lower, high - period}};
}

IndexRange merge_ranges(IndexRange a, IndexRange b, const GridDimension& target) {
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
  const bool known = first > -kUnknown && last < kUnknown;
  const bool far = first < -kFar || last > kFar;
  if (dimension.periodic() && known && far) {
    const std::int64_t turns = first / dimension.count * dimension.count;
    first -= turns;
    last -= turns;
  }
  return {saturate_index(first), saturate_index(last)};
}

}  // namespace coordreq
