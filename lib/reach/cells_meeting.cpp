#include "reach/cells_meeting.hpp"

#include <algorithm>

#include "base/requires.hpp"
#include "model/pieces.hpp"

namespace coordreq {

IndexRange cells_meeting(const GridDimension& dimension, Cells cells, const Rational& lower,
                         const Rational& upper, bool upper_attained) {
  // Cell k is [k - 1/2, k + 1/2] in units of the step, without its upper end if half-open.
  const Rational half(1, 2);
  const Rational low = (lower - dimension.first) / dimension.step;
  const Rational high = (upper - dimension.first) / dimension.step + half;
  const bool closed = cells == Cells::closed;
  const std::int64_t first = closed ? ceil_to_int(low - half) : floor_to_int(low + half);
  const std::int64_t last = closed || upper_attained ? floor_to_int(high) : ceil_to_int(high) - 1;
  return raw_range(dimension, first, last);
}

IndexRange cells_meeting(const GridDimension& dimension, Cells cells, const Interval& enclosure) {
  REQUIRES(enclosure.is_finite());
  return cells_meeting(dimension, cells, exact(enclosure.lower) - dimension.measurement_error,
                       exact(enclosure.upper) + dimension.measurement_error, true);
}

IndexRange cells_meeting_shifted(const GridDimension& dimension, Cells cells, const Interval& shift) {
  const Rational reach = dimension.step / 2 + 2 * dimension.measurement_error;
  return cells_meeting(dimension, cells, dimension.first - reach + exact(shift.lower),
                       dimension.first + reach + exact(shift.upper), false);
}

IndexRange cells_covering(const GridDimension& dimension, const Rational& lower, const Rational& upper) {
  const Rational reach = dimension.radius() + dimension.measurement_error;
  const std::int64_t first = floor_to_int((lower + reach - dimension.first) / dimension.step);
  const std::int64_t last = ceil_to_int((upper - reach - dimension.first) / dimension.step);
  // Where cells overlap, each of several may cover all.
  return raw_range(dimension, first, std::max(first, last));
}

IndexRange cells_covering_shifted(const GridDimension& dimension, const Interval& shift) {
  REQUIRES(shift.contains(0.0));
  return raw_range(dimension, floor_to_int(exact(shift.lower) / dimension.step),
                   ceil_to_int(exact(shift.upper) / dimension.step));
}

}  // namespace coordreq
