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

/// A part that turns, though it is least at one end and greatest at the other, cut at a valley: on the way
/// from the least end the function falls nowhere as far as to there. So all that follows is at least as high,
/// and the part is the maximum of what lies on both sides, if the side that follows goes on downward before
/// the valley.
struct Valley {
  std::size_t place = 0;       ///< number of its end
  PiecewiseLinear side;        ///< what follows, with its first line going on before the valley
  bool is_flat_after = false;  ///< the last line of the side, or the first, says what lies beyond the part
  std::optional<Line> below;   ///< where that line is not below all that lies between it and the valley
};

/// @pre unchecked: between these two ends `f` neither rises nor falls everywhere, and is nowhere as small or
/// as great as at them.
[[nodiscard]] Valley deepest_valley(const PiecewiseLinear& f, std::size_t first, std::size_t last);

}  // namespace coordreq
