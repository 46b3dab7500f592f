#pragma once

#include <vector>

#include "base/fast_paths.hpp"
#include "base/requires.hpp"
#include "reach/jacobian.hpp"
#include "reach/sensitivity.hpp"
#include "reach/turning_product.hpp"

namespace coordreq {

/// How much the state after all steps so far depends on the initial state and on the disturbances: for a
/// solution x and a nominal solution z, whose discontinuities are pinned,
///
///     x(t) - z(t)  in  initial (x(0) - z(0)) + integral of K(s) (w(s) - v(s)) ds + [-jump, jump]
///
/// with K(s) in `kernel` for all s, and `weight` at least the integral of |K(s)|. Matrices n x n and n x m.
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
  [[nodiscard]] const Interval& initial(std::size_t i, std::size_t j) const {
    return initial_(index(i), index(j));
  }
  [[nodiscard]] const Interval& kernel(std::size_t i, std::size_t l) const {
    return kernel_(index(i), index(l));
  }
  [[nodiscard]] double weight(std::size_t i, std::size_t l) const { return weight_(index(i), index(l)); }
  /// Puts a better bound there. @pre it is not larger. @pre unchecked: it is one
  void set_weight(std::size_t i, std::size_t l, double bound) {
    REQUIRES(bound <= weight(i, l));
    weight_(index(i), index(l)) = bound;
  }
  [[nodiscard]] double jump(std::size_t i) const { return jump_(index(i)); }

 private:
  static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

  void intersect_with_turning(const IntervalMatrix& transition);

  bool turns_ = fast_paths().turning_products;
  bool bounded_ = true;
  bool first_ = true;
  IntervalMatrix initial_;
  TurningProduct turning_;  ///< the same, kept from the first long product on
  std::vector<IntervalMatrix> first_steps_;
  IntervalMatrix kernel_;
  RealMatrix weight_;
  RealVector jump_;
};

}  // namespace coordreq
