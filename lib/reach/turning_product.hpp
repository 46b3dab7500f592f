#pragma once

#include <span>
#include <vector>

#include "numeric/interval.hpp"

namespace coordreq {

/// The product T_k ... T_2 T_1 of interval matrices, in coordinates that turn with it: C + Q R with C, Q of
/// doubles, Q nearly orthogonal, and R of small intervals (Lohner 1987). Multiplying intervals out would let
/// their widths grow in every step of a rotation.
///
/// Over-approximates. Matrices are row-major, n x n.
class TurningProduct {
 public:
  explicit TurningProduct(std::size_t dimension);

  /// No factor yet: the identity.
  void reset();
  /// Multiplies by a bounded matrix from the left.
  void append(std::span<const Interval> factor);
  /// Encloses an entry of the product; the whole line if the coordinates were lost to rounding.
  [[nodiscard]] Interval entry(std::size_t i, std::size_t j) const;

 private:
  using Intervals = std::vector<Interval>;
  using Numbers = std::vector<double>;

  [[nodiscard]] Intervals times(std::span<const Interval> a, std::span<const Interval> b) const;
  [[nodiscard]] Numbers middle_times(std::span<const Interval> factor, const Numbers& b) const;
  [[nodiscard]] Numbers orthogonal(Numbers columns) const;
  [[nodiscard]] Intervals inverse(const Numbers& orthogonal);

  std::size_t n_;
  bool lost_ = false;
  Numbers middle_;
  Numbers frame_;
  Intervals rest_;
};

}  // namespace coordreq
