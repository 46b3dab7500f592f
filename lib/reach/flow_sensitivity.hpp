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
  [[nodiscard]] Interval initial(std::size_t i, std::size_t j) const {
    return initial_(index(i), index(j)).interval();
  }
  [[nodiscard]] Interval kernel(std::size_t i, std::size_t l) const {
    return kernel_(index(i), index(l)).interval();
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

  void add_disturbances(const TransitionMatrix& transition, const Jacobian& jacobian);
  void carry_on(const TransitionMatrix& transition);
  void append_to_turning(const UpwardMatrix& transition);

  bool turns_ = fast_paths().turning_products;
  bool bounded_ = true;
  bool first_ = true;
  UpwardMatrix initial_;
  TurningProduct turning_;  ///< the same, kept from the first long product on
  std::vector<UpwardMatrix> first_steps_;
  std::size_t step_count_ = 0;  ///< of those that count as first
  UpwardMatrix kernel_;
  RealMatrix weight_;
  RealVector jump_;

  // Scratch memory.
  UpwardMatrix next_initial_;
  UpwardMatrix acting_;  ///< of the disturbances
  UpwardMatrix now_;
  UpwardMatrix before_;
  RealMatrix next_weight_;
  RealVector next_jump_;
};

}  // namespace coordreq
