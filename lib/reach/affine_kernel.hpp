#pragma once

#include <span>
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
  AffineKernel(std::size_t states, std::size_t disturbances);

  /// An upper bound for state i and disturbance l.
  /// @param jacobian the matrices, evaluated over any box
  [[nodiscard]] double integral(const Jacobian& jacobian, const Interval& tau, std::size_t i, std::size_t l);

 private:
  static constexpr std::size_t kTerms = 24;

  void forget_unless_same(const Jacobian& jacobian);
  void set_system(const Jacobian& jacobian, std::size_t l);
  void expand();
  double remainder(double duration);
  bool add_piece(double duration, bool smallest, double& sum);

  std::size_t n_;
  std::size_t m_;
  TransitionMatrix transition_;
  std::vector<Interval> system_;      ///< A
  std::vector<Interval> derivative_;  ///< A^k b / k!, k <= kTerms
  std::vector<Interval> taylor_;      ///< coefficients of the kernel where the next piece starts
  std::vector<Interval> row_;         ///< row i of exp(A s) there
  std::vector<Interval> next_row_;
  std::vector<bool> none_damped_;
  std::vector<Interval> known_state_;
  std::vector<Interval> known_disturbance_;
  std::vector<double> known_;  ///< negative: not known
};

}  // namespace coordreq
