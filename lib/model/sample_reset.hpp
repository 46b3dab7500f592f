#pragma once

#include "model/uniform_grid.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// The value after a sample, given that at the end of the period (contract, "Leaving the domain"): `periodic`
/// brings it to [lower, upper), `saturate` to the first or last grid point on its side; the other rules leave
/// it as it is.
[[nodiscard]] Rational reset_at_sample(const GridDimension& dimension, const Rational& value);

}  // namespace coordreq
