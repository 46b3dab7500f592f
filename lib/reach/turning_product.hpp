#pragma once

#include <Eigen/QR>
#include <vector>

#include "numeric/upward_matrix.hpp"

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
  void append(const UpwardMatrix& factor);
  /// Encloses the product; whole lines if the coordinates were lost to rounding.
  [[nodiscard]] const UpwardMatrix& enclosure() const { return enclosure_; }

 private:
  void find_frame();
  void find_inverse();
  void turn(const UpwardMatrix& factor);
  void multiply_out();

  bool lost_ = false;
  RealMatrix middle_;
  RealMatrix frame_;
  UpwardMatrix rest_;
  UpwardMatrix enclosure_;

  // Scratch memory.
  RealMatrix about_;  ///< the middle of the factor
  RealMatrix next_middle_;
  RealMatrix next_frame_;
  RealMatrix columns_;
  RealMatrix sorted_;
  RealRow widths_;
  RealVector workspace_;
  std::vector<Eigen::Index> order_;
  Eigen::HouseholderQR<RealMatrix> decomposition_;
  UpwardMatrix back_;  ///< the inverse of the next frame
  UpwardMatrix turned_;
  UpwardMatrix turn_;
  UpwardMatrix error_;
  UpwardMatrix next_rest_;
};

}  // namespace coordreq
