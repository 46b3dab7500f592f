#pragma once

#include <vector>

#include "reach/flow_helpers.hpp"

namespace coordreq {

/// long double as an evaluation domain; NaN where undefined.
struct Real {
  long double value = 0.0L;
};
[[nodiscard]] Real from_rational(const Real* tag, const Rational& q);
[[nodiscard]] Real apply(Operator op, const Real& a);
[[nodiscard]] Real apply(Operator op, const Real& a, const Real& b);
[[nodiscard]] Truth compare(Operator op, const Real& a, const Real& b);
[[nodiscard]] Real select(Truth condition, const Real& a, const Real& b);

/// A disturbance that is `values[k]` (one a disturbance) from the time `k` parts of tau on.
using Signal = std::vector<std::vector<long double>>;

/// Follows one solution of a case with the classical Runge-Kutta method in long double. States with a limit
/// are stopped at it.
/// @returns the states at the start and after each of `steps` steps
[[nodiscard]] std::vector<std::vector<long double>> integrate(const FlowCase& system,
                                                              const std::vector<long double>& start,
                                                              const Signal& signal, int steps);

}  // namespace coordreq
