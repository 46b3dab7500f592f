#pragma once

#include "numeric/matrix.hpp"

namespace coordreq {

/// The product T_k ... T_2 T_1 of square interval matrices, in coordinates that turn with it: C + Q R with C,
/// Q of doubles, Q nearly orthogonal, and R of small intervals (Lohner 1987). Multiplying intervals out would
/// let their widths grow in every step of a rotation.
///
/// Over-approximates.
class TurningProduct {
 public:
  explicit TurningProduct(Eigen::Index dimension);

  /// No factor yet: the identity.
  void reset();
  /// Multiplies by a bounded matrix from the left.
  void append(const IntervalMatrix& factor);
  /// Encloses an entry of the product; the whole line if the coordinates were lost to rounding.
  [[nodiscard]] Interval entry(Eigen::Index i, Eigen::Index j) const;

 private:
  [[nodiscard]] RealMatrix orthogonal(const RealMatrix& columns) const;
  [[nodiscard]] IntervalMatrix inverse(const RealMatrix& orthogonal);

  bool lost_ = false;
  RealMatrix middle_;
  RealMatrix frame_;
  IntervalMatrix rest_;
};

}  // namespace coordreq
