#pragma once

#include <optional>
#include <string>
#include <vector>

#include "numeric/rational.hpp"

// Whether the grid of a file that others wrote is that of a spec: numbers in it may be off in their last
// digits, since they are sums of rounded steps.
namespace coordreq {

/// How far a grid point in a file may be off, as a part of the distance of neighbours.
inline constexpr double kGridTolerance = 1e-3;

/// The smallest distance of two of the points; none if there is but one.
[[nodiscard]] std::optional<double> spacing(const std::vector<Rational>& points);

/// Whether `found` is `expected` up to that tolerance.
/// @param distance of neighbours; none: there is but one point, which is compared to nine digits
[[nodiscard]] bool same_point(double found, double expected, std::optional<double> distance);

}  // namespace coordreq
