#include "reach/stiff_solver.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace coordreq {
namespace {

constexpr int kStages = 5;
using Square = Eigen::Matrix<double, kStages, kStages>;
using StageRow = Eigen::Matrix<double, 1, kStages>;

constexpr int kMostIterations = 12;
constexpr double kNewtonShare = 0.01;       ///< of the tolerance: where Newton steps end
constexpr double kSmallestShare = 0x1p-50;  ///< of the time: shorter steps are none
constexpr double kFilter = 0.159;           ///< of the error estimate, about 1 / the real eigenvalue of A^-1

/// The coefficients of the method.
struct Radau {
  Square a;        ///< [stage][stage] increments from derivatives, in steps
  Square inverse;  ///< of it
  Square powers;  ///< polynomial through increments: coefficients of share, share^2, ... from those of stages
  StageRow at_start;  ///< the derivative of the polynomial at the start, from derivatives of stages
};

Radau make_radau() {
  using Exact = Eigen::Matrix<long double, kStages, kStages>;
  const long double nodes[kStages] = {
      0.05710419611451768219312119255411562L, 0.27684301363812382768004599768562514L,
      0.58359043236891682005669766866291725L, 0.86024013565621944784791291887511976L, 1.0L};
  Exact values, integrals;
  for (int i = 0; i < kStages; ++i) {
    long double power = 1.0L;
    for (int k = 0; k < kStages; ++k) {
      values(i, k) = power;
      power *= nodes[i];
      integrals(i, k) = power / static_cast<long double>(k + 1);
    }
  }
  const Exact inverse = values.inverse();
  const Exact a = integrals * inverse;
  Exact shares;
  for (int i = 0; i < kStages; ++i) shares.row(i) = values.row(i) * nodes[i];
  return {.a = a.cast<double>(),
          .inverse = a.inverse().cast<double>(),
          .powers = shares.inverse().cast<double>(),
          .at_start = inverse.row(0).cast<double>()};
}

const Radau& radau() {
  static const Radau made = make_radau();
  return made;
}

}  // namespace

StiffSolver::StiffSolver(Field field, std::span<const double> scale, double tolerance)
    : field_(std::move(field)),
      scale_(Eigen::Map<const Values>(scale.data(), static_cast<Eigen::Index>(scale.size()))),
      tolerance_(tolerance),
      derivative_(scale_.size()),
      jacobian_(scale_.size(), scale_.size()),
      increments_(Stages::Zero(scale_.size(), kStages)) {}

void StiffSolver::begin(const Values& x) {
  x_ = from_ = x;
  length_ = time_ = 0.0;
  increments_.setZero();
}

/// In units of the larger of the state and its scale.
double StiffSolver::relative(const Values& difference) const {
  if (!difference.allFinite()) return std::numeric_limits<double>::infinity();
  return (difference.array().abs() / x_.array().abs().max(scale_.array())).maxCoeff();
}

/// In which a hundredth of the state changes.
double StiffSolver::first_length() const {
  const double rate = relative(derivative_);
  return rate > 0.0 ? 0.01 / rate : std::numeric_limits<double>::infinity();
}

/// f and its Jacobian at x_. @returns whether f is defined there
bool StiffSolver::differentiate() {
  field_(x_, derivative_);
  if (!derivative_.allFinite()) return false;
  Values beside(x_);
  Values there(x_.size());
  for (Eigen::Index j = 0; j < x_.size(); ++j) {
    const double by = 0x1p-26 * std::max(std::fabs(x_(j)), scale_(j));
    jacobian_.col(j).setZero();
    for (const double side : {by, -by}) {
      beside(j) = x_(j) + side;
      field_(beside, there);
      if (!there.allFinite()) continue;
      jacobian_.col(j) = (there - derivative_) / (beside(j) - x_(j));
      break;
    }
    beside(j) = x_(j);
  }
  return true;
}

/// The increments of a step of length h. @returns whether they were found
bool StiffSolver::solve(double h) {
  const Eigen::Index n = x_.size();
  const Square& a = radau().a;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n * kStages, n * kStages);
  for (Eigen::Index i = 0; i < kStages; ++i) {
    for (Eigen::Index j = 0; j < kStages; ++j) matrix.block(n * i, n * j, n, n) -= h * a(i, j) * jacobian_;
  }
  const Eigen::PartialPivLU<Eigen::MatrixXd> newton(matrix);
  Stages slopes(n, kStages);
  Values there(n);
  increments_.setZero();
  double before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    for (Eigen::Index i = 0; i < kStages; ++i) {
      field_(x_ + increments_.col(i), there);
      if (!there.allFinite()) return false;
      slopes.col(i) = there;
    }
    const Stages residual = h * slopes * a.transpose() - increments_;
    const Values change = newton.solve(Values(residual.reshaped()));
    increments_ += change.reshaped(n, kStages);
    double size = 0.0;
    for (Eigen::Index i = 0; i < kStages; ++i) size = std::max(size, relative(change.segment(n * i, n)));
    if (size <= kNewtonShare * tolerance_) return true;
    if (size > 0.5 * before) return size <= tolerance_;  // as far as rounding lets it come, or no further
    before = size;
  }
  return false;
}

/// What the polynomial's derivative lacks at the start of the step, as fast decay lets it last; in units of
/// what is tolerated.
double StiffSolver::relative_error(double h) const {
  const Eigen::Index n = x_.size();
  const Values lack = h * derivative_ - increments_ * (radau().at_start * radau().inverse).transpose();
  const Eigen::MatrixXd filter = Eigen::MatrixXd::Identity(n, n) - kFilter * h * jacobian_;
  return relative(filter.partialPivLu().solve(kFilter * lack)) / tolerance_;
}

double StiffSolver::step(double most) {
  if (!differentiate()) return 0.0;
  if (length_ == 0.0) length_ = first_length();
  for (;;) {
    // Nothing is left over that is too short for a step.
    const double h = 1.1 * length_ >= most ? most : length_;
    if (h < kSmallestShare * (time_ + most)) return 0.0;
    if (!solve(h)) {
      length_ = 0.25 * h;
      continue;
    }
    const double error = relative_error(h);
    const double growth = error > 0.0 ? std::clamp(0.9 * std::pow(error, -1.0 / 6), 0.2, 5.0) : 5.0;
    if (!(error <= 1.0)) {
      length_ = std::min(growth, 0.9) * h;
      continue;
    }
    length_ = growth * h;
    time_ += h;
    from_ = x_;
    x_ += increments_.col(kStages - 1);
    return h;
  }
}

void StiffSolver::interpolate(double share, Values& x) const {
  if (share >= 1.0) {
    x = x_;
    return;
  }
  StageRow powers;
  double power = 1.0;
  for (int k = 0; k < kStages; ++k) powers(k) = power *= share;
  x = from_ + increments_ * (powers * radau().powers).transpose();
}

}  // namespace coordreq
