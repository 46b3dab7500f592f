#include "verify/transition_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace coordreq {
namespace {

using Matrix = std::vector<Interval>;

constexpr int kTerms = 5;  // besides the remainder
const Interval kZero{0.0, 0.0};
const Interval kOne{1.0, 1.0};

double magnitude(const Interval& a) {
  return std::max(std::fabs(a.lower), std::fabs(a.upper));
}

Interval point_of(double value) {
  return {value, value};
}

Matrix identity(std::size_t n) {
  Matrix result(n * n, kZero);
  for (std::size_t i = 0; i < n; ++i) result[i * n + i] = kOne;
  return result;
}

/// Zeros stay zeros: an entry without a path of influence must not get a sign by rounding.
Matrix product(std::size_t n, const Matrix& a, const Matrix& b) {
  Matrix result(n * n, kZero);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      if (magnitude(a[i * n + k]) == 0.0) continue;
      for (std::size_t j = 0; j < n; ++j) result[i * n + j] = result[i * n + j] + a[i * n + k] * b[k * n + j];
    }
  }
  return result;
}

/// The largest sum of magnitudes of a row, rounded up.
Interval norm_of(std::size_t n, const Matrix& a) {
  Interval norm = kZero;
  for (std::size_t i = 0; i < n; ++i) {
    Interval row = kZero;
    for (std::size_t j = 0; j < n; ++j) row = row + point_of(magnitude(a[i * n + j]));
    norm = max(norm, row);
  }
  return norm;
}

/// Whether i depends on j, directly or by way of others; on itself always.
std::vector<bool> influences(std::size_t n, const Matrix& a) {
  std::vector<bool> path(n * n, false);
  for (std::size_t e = 0; e < n * n; ++e) path[e] = e / n == e % n || magnitude(a[e]) != 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; path[i * n + k] && j < n; ++j)
        path[i * n + j] = path[i * n + j] || path[k * n + j];
    }
  }
  return path;
}

}  // namespace

std::vector<Interval> transition_bounds(std::size_t n, const std::vector<Interval>& jacobian,
                                        const Interval& duration) {
  const Interval scaled = norm_of(n, jacobian) * point_of(duration.upper);
  Matrix power = identity(n);
  Matrix sum = power;
  Interval weight = kOne;  // h^k / k!
  Interval tail = kOne;    // (|J| h)^k / k!
  for (int k = 1; k <= kTerms; ++k) {
    power = product(n, power, jacobian);
    weight = weight * duration / point_of(k);
    tail = tail * scaled / point_of(k);
    for (std::size_t e = 0; e < sum.size(); ++e) sum[e] = sum[e] + power[e] * weight;
  }
  tail = tail * scaled * exp(scaled);
  const std::vector<bool> path = influences(n, jacobian);
  for (std::size_t e = 0; e < sum.size(); ++e) {
    if (path[e]) sum[e] = sum[e] + Interval{-tail.upper, tail.upper};
  }
  return sum;
}

}  // namespace coordreq
