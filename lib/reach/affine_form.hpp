#pragma once

#include <optional>
#include <vector>

#include "numeric/matrix.hpp"
#include "reach/affine_dynamics.hpp"

namespace coordreq {

/// An equation for fixed parameters and inputs: state x + disturbance w + [lower, upper], where x are the
/// moving states and w the disturbances of some dependencies.
struct AffineForm {
  RationalRow state;
  RationalRow disturbance;
  Rational lower;
  Rational upper;
};

/// @param slots exact values of the parameters and inputs at their slots
/// @returns nothing if the equation is not of that form
/// @throws SpecError if it is not defined there; the message names the state and the values
[[nodiscard]] std::optional<AffineForm> affine_form(const SystemSpec& spec, std::size_t equation,
                                                    const Dependencies& dependencies,
                                                    const std::vector<Rational>& slots);

}  // namespace coordreq
