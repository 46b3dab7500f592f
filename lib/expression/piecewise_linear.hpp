#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "numeric/rational.hpp"

namespace coordreq {

/// slope * x + offset
struct Line {
  Rational slope;
  Rational offset;

  [[nodiscard]] Rational at(const Rational& x) const { return slope * x + offset; }
  bool operator==(const Line& other) const = default;
};

/// A continuous function on an interval that is linear between its kinks.
struct PiecewiseLinear {
  std::vector<Rational> ends;  ///< of the pieces, ascending; one more than pieces
  std::vector<Line> lines;     ///< by piece; neighbours differ

  [[nodiscard]] Rational at_end(std::size_t i) const { return lines[i == 0 ? 0 : i - 1].at(ends[i]); }
};

/// Through the points, those left out at which it does not bend. @pre as linear_table()
[[nodiscard]] PiecewiseLinear through_points(std::span<const Rational> x, std::span<const Rational> value);

/// The least of some lines, and of a constant.
struct LeastLine {
  std::vector<std::size_t> lines;  ///< numbers of pieces, ascending
  std::optional<Rational> most;    ///< the constant
  bool operator==(const LeastLine& other) const = default;
};

/// Minima of which the function is the maximum. A constant is there where the minimum turns within the
/// interval, or where the function does, so that intervals see how far it goes.
[[nodiscard]] std::vector<LeastLine> as_maximum_of_minima(const PiecewiseLinear& f);

}  // namespace coordreq
