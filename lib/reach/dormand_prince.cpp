#include "reach/dormand_prince.hpp"

namespace coordreq {
namespace {

/// Row s: what the slopes before stage s count in it. That of the last stage is the solution of order 5.
const Eigen::Matrix<double, 7, 7>& weights() {
  static const Eigen::Matrix<double, 7, 7> table{
      {0, 0, 0, 0, 0, 0, 0},
      {1.0 / 5, 0, 0, 0, 0, 0, 0},
      {3.0 / 40, 9.0 / 40, 0, 0, 0, 0, 0},
      {44.0 / 45, -56.0 / 15, 32.0 / 9, 0, 0, 0, 0},
      {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729, 0, 0, 0},
      {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656, 0, 0},
      {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84, 0}};
  return table;
}

using Weights = Eigen::Matrix<double, 7, 1>;

/// Order 5 less order 4.
const Weights& error_weights() {
  static const Weights table{71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                             -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
  return table;
}

/// Weights of the term of degree 4 in the interpolant.
const Weights& interpolation_weights() {
  static const Weights table{-12715105075.0 / 11282082432.0,  0,
                             87487479700.0 / 32700410799.0,   -10690763975.0 / 1880347072.0,
                             701980252875.0 / 199316789632.0, -1453857185.0 / 822651844.0,
                             69997945.0 / 29380423.0};
  return table;
}

}  // namespace

DormandPrince::DormandPrince(std::size_t dimension)
    : derivative_(static_cast<Eigen::Index>(dimension)),
      slopes_(static_cast<Eigen::Index>(dimension), kStages) {}

DormandPrince::Values DormandPrince::increment(Eigen::Index stage) const {
  return slopes_.leftCols(stage).lazyProduct(weights().row(stage).head(stage).transpose());
}

DormandPrince::Values DormandPrince::error() const {
  return step_ * slopes_.lazyProduct(error_weights());
}

double DormandPrince::stiffness() const {
  const Values apart = end_ - start_ - step_ * increment(kStages - 2);
  const double distance = apart.norm();
  return distance > 0.0 ? step_ * (slopes_.col(kStages - 1) - slopes_.col(kStages - 2)).norm() / distance
                        : 0.0;
}

void DormandPrince::interpolate(double share, Values& x) const {
  const double rest = 1.0 - share;
  const Values whole = end_ - start_;
  const Values first = step_ * slopes_.col(0) - whole;
  const Values last = whole - step_ * slopes_.col(kStages - 1) - first;
  const Values quartic = step_ * slopes_.lazyProduct(interpolation_weights());
  x = start_ + share * (whole + rest * (first + share * (last + rest * quartic)));
}

}  // namespace coordreq
