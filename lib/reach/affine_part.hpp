#pragma once

#include <cstdint>
#include <vector>

#include "expression/dual.hpp"
#include "numeric/matrix.hpp"
#include "reach/affine_dynamics.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The states A in which the next value of a state is affine, with coefficients that depend on inputs and
/// parameters only:
///
///     x_i(next) = sum_{j in A} Phi_ij x_j + b_i,
///
/// b_i free of A but for any dependence on all else: other states, inputs, parameters, disturbances.
struct AffinePart {
  std::vector<std::int32_t> states;      ///< A, ascending; empty if nothing was found
  std::vector<std::int32_t> inputs;      ///< that Phi may depend on, ascending
  std::vector<std::int32_t> parameters;  ///< likewise
};

/// Read off the equations: in discrete time off that of `state`, in continuous time off all that it depends
/// on, where besides no equation outside of A may mention a state of A. States that are periodic or have a
/// `stop` are not in A. A may be smaller than it could.
[[nodiscard]] AffinePart find_affine_part(const SystemSpec& spec, const Dependencies& dependencies,
                                          std::size_t state);

/// Encloses Phi for given inputs and parameters: in continuous time exp(M tau), where M are the derivatives
/// of the equations of A by A. Over-approximates. Not thread-safe.
class AffineCoefficients {
 public:
  /// @pre `part.states` is not empty. @pre unchecked: `spec` outlives this object
  AffineCoefficients(const SystemSpec& spec, const AffinePart& part, std::size_t state);

  /// Sets the box of an input or parameter that Phi depends on.
  void set(std::uint32_t slot, const Interval& box) { slots_[slot] = Dual::constant(box); }

  /// @returns false if no bound was found
  bool enclose();

  /// Phi_ij; j is a position in part.states, `i` one too, in discrete time 0 for the state itself.
  [[nodiscard]] const Interval& phi(std::size_t i, std::size_t j) const {
    return phi_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }

 private:
  bool derive(std::size_t equation, std::size_t row);
  bool exponentiate();

  const SystemSpec* spec_;
  AffinePart part_;
  std::vector<std::size_t> equations_;  ///< one a row of Phi
  std::vector<Dual> slots_;
  IntervalMatrix matrix_;
  IntervalMatrix phi_;
};

}  // namespace coordreq
