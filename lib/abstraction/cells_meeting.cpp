#include "abstraction/cells_meeting.hpp"

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
  return {saturate_index(first), saturate_index(last)};
}

IndexRange cells_meeting(const GridDimension& dimension, Cells cells, const Interval& enclosure) {
  return cells_meeting(dimension, cells, exact(enclosure.lower) - dimension.measurement_error,
                       exact(enclosure.upper) + dimension.measurement_error, true);
}

IndexRange cells_meeting_shifted(const GridDimension& dimension, Cells cells, const Interval& shift) {
  const Rational reach = dimension.step / 2 + 2 * dimension.measurement_error;
  return cells_meeting(dimension, cells, dimension.first - reach + exact(shift.lower),
                       dimension.first + reach + exact(shift.upper), false);
}

}  // namespace coordreq
