#pragma once

#include <optional>
#include <vector>

#include "numeric/matrix.hpp"
#include "reach/affine_dynamics.hpp"

namespace coordreq {

/// The flow of x' = A x + B w + c with nilpotent A, seen from state i:
///
///   x_i(t) = sum_k r_k x(0) t^k / k! + sum_k r_k c t^(k+1) / (k+1)! + integral_0^t g(s) w(t - s) ds,
///   r_k = e_i A^k, g(s) = sum_k r_k B s^k / k!.
///
/// The sums end because A is nilpotent, so everything is rational. A measurable w in a box reaches every
/// value of mid * integral(g) +- radius * integral(|g|), both ends included (bang-bang).
struct NilpotentFlow {
  RationalMatrix rows;     ///< r_k, up to the last that is not zero
  RationalVector lower;    ///< r_k c
  RationalVector upper;    ///< differs where a constant is only known to be in an interval
  RationalMatrix kernels;  ///< r_k B / k!, one column a disturbance

  /// The polynomial g of a disturbance, by ascending powers of s.
  [[nodiscard]] std::vector<Rational> kernel(std::size_t disturbance) const {
    const auto column = kernels.col(static_cast<Eigen::Index>(disturbance));
    return {column.begin(), column.end()};
  }
};

/// @returns nothing if the system is not of that form, has a periodic state that an
///   equation uses
/// @throws SpecError as affine_form() does. @pre `state` is a moving one
[[nodiscard]] std::optional<NilpotentFlow> nilpotent_flow(const SystemSpec& spec, std::size_t state,
                                                          const Dependencies& dependencies,
                                                          const std::vector<Rational>& slots);

/// t^k / k! for k = 0, ..., count - 1.
[[nodiscard]] RationalVector exponential_terms(const Rational& t, Eigen::Index count);

}  // namespace coordreq
