#include "spec/grid_dimension.hpp"

#include <algorithm>

#include "base/requires.hpp"
#include "spec/system_spec.hpp"

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
  if (k == 0) piece.lower -= dimension.extension_below;
  if (k == dimension.count - 1) piece.upper += dimension.extension_above;
  if (dimension.below == Outside::stop) piece.lower = std::max(piece.lower, dimension.first);
  if (dimension.above == Outside::stop) {
    piece.upper = std::min(piece.upper, dimension.point(dimension.count - 1));
  }
  return piece;
}

}  // namespace

GridDimension dimension_of(const StateSpec& state) {
  return {.name = state.name,
          .first = state.grid.first,
          .step = state.grid.step,
          .count = state.grid.count,
          .discrete = state.discrete,
          .below = state.below,
          .above = state.above,
          .lower = state.lower,
          .upper = state.upper,
          .measurement_error = state.measurement_error};
}

std::vector<Piece> pieces(const GridDimension& dimension, std::int64_t k) {
  REQUIRES(0 <= k && k < dimension.count);
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

}  // namespace coordreq
