#pragma once

#include "model/outside.hpp"
#include "model/uniform_grid.hpp"
#include "numeric/interval.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// Raw indices of the cells of a continuous dimension that meet [lower, upper], contract "Cells". Exact.
/// @param upper_attained whether `upper` itself is reached; only half-open cells ask
[[nodiscard]] IndexRange cells_meeting(const GridDimension& dimension, Cells cells, const Rational& lower,
                                       const Rational& upper, bool upper_attained);

/// cells_meeting() for an enclosure in doubles, widened by the dimension's measurement error.
/// @pre the ends are finite
[[nodiscard]] IndexRange cells_meeting(const GridDimension& dimension, Cells cells,
                                       const Interval& enclosure);

/// Raw indices, relative to the own one, of the cells that meet the own cell moved by `shift`: the whole row
/// of a table where x' = x + shift. Measurement errors before and after are included.
[[nodiscard]] IndexRange cells_meeting_shifted(const GridDimension& dimension, Cells cells,
                                               const Interval& shift);

/// Raw indices first, ..., last of cells that together cover [lower, upper], as few as possible: cells are
/// closed in either mode and widened by the measurement error, as S knows them (see safe_set()). A set that
/// ends on a face does not need the neighbour. Exact.
[[nodiscard]] IndexRange cells_covering(const GridDimension& dimension, const Rational& lower,
                                        const Rational& upper);

/// The cells that cover a whole cell moved by each number of `shift`, relative to that cell. @pre 0 in
/// `shift`
[[nodiscard]] IndexRange cells_covering_shifted(const GridDimension& dimension, const Interval& shift);

}  // namespace coordreq
