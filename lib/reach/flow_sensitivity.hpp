#pragma once

#include <span>
#include <vector>

#include "reach/jacobian.hpp"
#include "reach/sensitivity.hpp"
#include "reach/turning_product.hpp"

namespace coordreq {

/// How much the state after all steps so far depends on the initial state and on the disturbances: for a
/// solution x and a nominal solution z, whose discontinuities are pinned,
///
///     x(t) - z(t)  in  initial (x(0) - z(0)) + integral of K(s) (w(s) - v(s)) ds + [-jump, jump]
///
/// with K(s) in `kernel` for all s, and `weight` at least the integral of |K(s)|. Row-major, n x n and n x m.
class FlowSensitivity {
 public:
  FlowSensitivity(std::size_t states, std::size_t disturbances);

  /// No step yet: the identity.
  void reset();
  /// Adds a step with these transition matrices, its right-hand side bounded by the Jacobian.
  void append(const TransitionMatrix& transition, const Jacobian& jacobian);
  /// Adds a step of which nothing is known. From then on everything is unbounded.
  void lose();

  [[nodiscard]] bool is_bounded() const { return bounded_; }
  [[nodiscard]] const Interval& initial(std::size_t i, std::size_t j) const { return initial_[i * n_ + j]; }
  [[nodiscard]] const Interval& kernel(std::size_t i, std::size_t l) const { return kernel_[i * m_ + l]; }
  [[nodiscard]] double weight(std::size_t i, std::size_t l) const { return weight_[i * m_ + l]; }
  /// Puts a better bound there. REQUIRES: it is one.
  void set_weight(std::size_t i, std::size_t l, double bound) { weight_[i * m_ + l] = bound; }
  [[nodiscard]] double jump(std::size_t i) const { return jump_[i]; }

 private:
  void append_initial(const TransitionMatrix& transition);
  void append_kernel(const TransitionMatrix& transition, const Jacobian& jacobian);
  void append_sizes(const TransitionMatrix& transition, const Jacobian& jacobian);

  std::size_t n_;
  std::size_t m_;
  bool bounded_ = true;
  bool first_ = true;
  std::vector<Interval> initial_;
  TurningProduct turning_;  ///< the same
  std::vector<Interval> kernel_;
  std::vector<double> weight_;
  std::vector<double> jump_;
  std::vector<Interval> next_;
  std::vector<double> next_size_;
};

/// A x for a row of a matrix and a column, in intervals; entries that are 0 cost nothing.
[[nodiscard]] Interval scalar_product(std::span<const Interval> row, std::span<const Interval> matrix,
                                      std::size_t column, std::size_t columns);

}  // namespace coordreq
