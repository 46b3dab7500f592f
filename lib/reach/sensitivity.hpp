#pragma once

#include <vector>

#include "numeric/upward_matrix.hpp"

namespace coordreq {

/// Enclosures of the transition matrices of e' = (A(t) - diag(rho(t))) e, for every measurable A(t) in an
/// interval matrix and every rho(t) >= 0 that is 0 but for the damped states.
///
/// Peano-Baker series of A + alpha I with alpha such that no diagonal entry is negative: then off-diagonal
/// signs that are consistent (a system that is monotone in some order of the orthants) give entries whose
/// sign is proved, and the magnitudes are the growth bound, exp of the Metzler matrix of A (Reissig, Weber,
/// Rungger 2017, Thm VIII.5, DOI 10.1109/TAC.2016.2593947). Damping puts a factor in [0, 1] wherever a
/// damped state is passed: what a `stop` does to the difference of two solutions, and what is left of a
/// diagonal entry that is unbounded below.
///
/// Matrices are n x n. Over-approximates. Scratch memory for one thread.
class TransitionMatrix {
 public:
  /// @param interval_terms how many terms of the series are multiplied out as intervals; beyond them only
  ///   magnitudes count
  TransitionMatrix(std::size_t dimension, std::size_t interval_terms);

  static constexpr std::size_t kFewTerms = 5;    ///< enough where the Jacobian is an interval anyway
  static constexpr std::size_t kManyTerms = 50;  ///< for a Jacobian known exactly

  /// @param jacobian the interval matrix; damped diagonal entries count with their upper ends only
  /// @returns false if no bound was found: entries are infinite, or the duration is too long
  bool enclose(const IntervalMatrix& jacobian, const Interval& duration, const std::vector<bool>& damped);

  /// Phi(h, 0).
  [[nodiscard]] const UpwardMatrix& end() const { return end_; }
  /// Puts what is known of an entry of it besides.
  void narrow_end(Eigen::Index i, Eigen::Index j, const Interval& known) {
    end_(i, j) = intersection(end_(i, j), UpwardInterval(known));
  }
  /// Phi(h, s) for all 0 <= s <= h.
  [[nodiscard]] const UpwardMatrix& range() const { return range_; }
  /// At least the integral of |Phi(h, s)| over 0 <= s <= h, entry by entry.
  [[nodiscard]] const RealMatrix& integral() const { return integral_; }

 private:
  bool shift(const IntervalMatrix& jacobian, double duration, const std::vector<bool>& damped);
  void find_signs();
  void apply_signs(UpwardMatrix& matrix) const;
  void start(const std::vector<bool>& damped);
  void add_term(std::size_t k, const UpwardInterval& duration, const std::vector<bool>& damped);
  [[nodiscard]] bool is_negligible() const;
  bool add_tail(std::size_t k, double duration);
  void widen_by_tail(bool halved);
  bool next_magnitude(std::size_t k, double duration);
  void integrate_magnitude(std::size_t k);
  void apply_shift(const Interval& duration);

  Eigen::Index n_;
  std::size_t interval_terms_;
  double alpha_ = 0.0;
  UpwardMatrix shifted_;  ///< A + alpha I
  UpwardMatrix term_;     ///< the k-th power of it times h^k / k!
  UpwardMatrix scaled_;
  RealMatrix magnitude_;  ///< bounds of |A + alpha I|, and of the k-th term
  RealMatrix size_;
  RealMatrix next_size_;
  MatrixOf<unsigned> signs_;  ///< which signs an entry of a power of A + alpha I can have
  UpwardMatrix end_;
  UpwardMatrix range_;
  RealMatrix integral_;
};

}  // namespace coordreq
