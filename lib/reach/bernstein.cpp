#include "reach/absolute_integral.hpp"

#include <cstddef>

#include "base/requires.hpp"

namespace coordreq {

std::vector<Rational> to_bernstein(const std::vector<Rational>& coefficient, const Rational& end) {
  REQUIRES(!coefficient.empty());
  const std::size_t n = coefficient.size() - 1;
  std::vector<Rational> scaled(n + 1);  // c_k * end^k / C(n, k)
  Rational factor = 1;
  for (std::size_t k = 0; k <= n; ++k) {
    scaled[k] = coefficient[k] * factor;
    if (k < n) factor *= end * Rational(static_cast<long>(k + 1)) / Rational(static_cast<long>(n - k));
  }
  std::vector<Rational> bernstein(n + 1);
  for (std::size_t i = 0; i <= n; ++i) {
    Rational binomial = 1;
    for (std::size_t k = 0; k <= i; ++k) {
      bernstein[i] += binomial * scaled[k];
      binomial *= Rational(static_cast<long>(i - k)) / Rational(static_cast<long>(k + 1));
    }
  }
  return bernstein;
}

}  // namespace coordreq
