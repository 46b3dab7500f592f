#pragma once

#include <vector>

#include "reach/jacobian.hpp"
#include "reach/sensitivity.hpp"

namespace coordreq {

/// Integrals of |(exp(A s) b)_i| over [0, tau] for an affine system x' = A x + b w + c: how much a
/// disturbance that acts with both signs can add.
///
/// Pieces on which the kernel's Taylor polynomial keeps its sign are integrated up to rounding; others are
/// halved down to 2^-26 tau, where the largest value counts. Over-approximates. Remembers the last system, as
/// it is the same for all boxes of initial states. Scratch memory for one thread.
class AffineKernel {
 public:
  explicit AffineKernel(std::size_t states);

  /// An upper bound for state i and disturbance l.
  /// @param jacobian the matrices, evaluated over any box
  [[nodiscard]] double integral(const Jacobian& jacobian, const Interval& tau, std::size_t i, std::size_t l);

 private:
  static constexpr Eigen::Index kTerms = 24;

  void forget_unless_same(const Jacobian& jacobian);
  void find_derivatives(Eigen::Index l);
  void expand();
  double remainder(double duration);
  bool add_piece(double duration, bool smallest, double& sum);

  TransitionMatrix transition_;
  IntervalMatrix system_;       ///< A, as known
  IntervalMatrix disturbance_;  ///< all columns b
  RealMatrix known_;            ///< the integrals; negative: not known
  IntervalMatrix derivative_;   ///< columns A^k b / k!, k <= kTerms
  IntervalRow row_;             ///< row i of exp(A s) where the next piece starts
  IntervalRow taylor_;          ///< coefficients of the kernel there
  std::vector<bool> none_damped_;
};

}  // namespace coordreq
