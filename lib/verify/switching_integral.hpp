#pragma once

#include <vector>

#include "numeric/rational.hpp"

namespace coordreq {

struct SwitchingIntegral {
  Rational plain;     ///< of g
  Rational absolute;  ///< of |g|, or a little more
  bool exact = true;  ///< `absolute` is the integral itself
};

/// Integrals of g(s) = sum_k coefficient[k] s^k and of |g| over [0, end], end > 0: what a constant and what a
/// switching disturbance of size 1 adds up to. Halves the range until g keeps its sign; what is left around
/// an irrational root is bounded from above.
[[nodiscard]] SwitchingIntegral integrate_switching(const std::vector<Rational>& coefficient,
                                                    const Rational& end);

}  // namespace coordreq
