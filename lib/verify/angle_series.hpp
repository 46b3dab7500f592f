#pragma once

#include "verify/arb.hpp"

namespace coordreq {

/// The series of atan2(y, x), cut off at `length`. Not finite where the balls hold the origin.
/// @returns whether the angle may jump in the balls; the series is then a constant that holds all angles
[[nodiscard]] bool angle_series(ArbSeries& result, const ArbSeries& y, const ArbSeries& x, slong length);

}  // namespace coordreq
