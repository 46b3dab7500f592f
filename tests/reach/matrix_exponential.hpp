#pragma once

#include <cmath>
#include <vector>

namespace coordreq {

using Vector = std::vector<long double>;
using Matrix = std::vector<Vector>;

inline Matrix product(const Matrix& a, const Matrix& b) {
  Matrix result(a.size(), Vector(a.size()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < a.size(); ++k) {
      for (std::size_t j = 0; j < a.size(); ++j) result[i][j] += a[i][k] * b[k][j];
    }
  }
  return result;
}

/// exp(A t) by scaling and squaring.
inline Matrix exponential(Matrix a, long double t) {
  constexpr int kHalvings = 8;
  const std::size_t n = a.size();
  Matrix result(n, Vector(n));
  Matrix term(n, Vector(n));
  for (std::size_t i = 0; i < n; ++i) result[i][i] = term[i][i] = 1.0L;
  for (Vector& row : a) {
    for (long double& entry : row) entry *= std::ldexp(t, -kHalvings);
  }
  for (int k = 1; k < 20; ++k) {
    term = product(term, a);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        term[i][j] /= k;
        result[i][j] += term[i][j];
      }
    }
  }
  for (int k = 0; k < kHalvings; ++k) result = product(result, result);
  return result;
}

}  // namespace coordreq
