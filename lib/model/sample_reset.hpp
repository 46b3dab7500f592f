#pragma once

#include "model/uniform_grid.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// What a sample makes of the value at the end of a period (contract, "Leaving the domain"): `periodic`
/// brings it to [lower, upper), `saturate` to the first or last grid point on its side, all else leaves it.
[[nodiscard]] Rational reset_at_sample(const GridDimension& dimension, const Rational& value);

}  // namespace coordreq
