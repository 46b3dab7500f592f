#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "numeric/rational.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// One state dimension: grid points first + k * step, k = 0, ..., count - 1, and what lies beyond them.
struct GridDimension {
  std::string name;
  Rational first;
  Rational step;
  std::int64_t count = 0;
  bool discrete = false;  ///< cells are points
  Outside below = Outside::unsafe;
  Outside above = Outside::unsafe;
  Rational lower;  ///< as written in the spec; [lower, upper) is one period of a periodic dimension
  Rational upper;
  Rational measurement_error = 0;  ///< how far the true state may be from the measured one
  /// How far beyond its outer face the first and the last cell count as going on (see safe_beyond_limits()).
  Rational extension_below = 0;
  Rational extension_above = 0;

  /// The dimension wraps round: first = lower, count * step = upper - lower.
  [[nodiscard]] bool periodic() const { return below == Outside::periodic; }
  [[nodiscard]] Rational point(std::int64_t k) const { return first + step * Rational(static_cast<long>(k)); }
  /// Half the width of a cell: step / 2, or 0 for a discrete dimension.
  [[nodiscard]] Rational radius() const { return discrete ? Rational(0) : Rational(step / 2); }
};

[[nodiscard]] GridDimension dimension_of(const StateSpec& state);

/// A closed interval of values that an expression can see.
struct Piece {
  Rational lower;
  Rational upper;
  [[nodiscard]] bool operator==(const Piece&) const = default;
};

/// Where the true state can be while cell k is measured: the closed cell (the point of a discrete dimension)
/// widened by the measurement error on both sides, as one piece. Beyond a `stop` limit there is no state, so
/// that half of the boundary cell does not count; an extended boundary cell is as long as its extension.
///
/// In a periodic dimension it is cut at the seam into representatives in [lower, upper), in the order along
/// the cell: at most two pieces, or [lower, upper] if it is as wide as the period. A cell that ends at
/// `upper` has the piece {lower} too, since that is how expressions see the point on the seam. A piece that
/// ends at `upper` includes it, although no state has this value: its limit counts. @pre 0 <= k < count
[[nodiscard]] std::vector<Piece> pieces(const GridDimension& dimension, std::int64_t k);

}  // namespace coordreq
