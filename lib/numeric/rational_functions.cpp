#include "numeric/rational_functions.hpp"

#include <algorithm>

#include "base/requires.hpp"

namespace coordreq {

std::size_t bit_size(const Rational& q) {
  return std::max(mpz_sizeinbase(q.get_num_mpz_t(), 2), mpz_sizeinbase(q.get_den_mpz_t(), 2));
}

std::optional<Rational> integer_power(const Rational& base, const Rational& exponent) {
  REQUIRES(is_integer(exponent));
  if (sgn(exponent) == 0 || base == 1) return Rational(1);
  if (sgn(base) == 0) return sgn(exponent) > 0 ? std::optional<Rational>(0) : std::nullopt;
  if (base == -1) return Rational(mpz_even_p(exponent.get_num_mpz_t()) != 0 ? 1 : -1);

  const mpz_class magnitude = abs(exponent.get_num());
  if (magnitude > kMostExactExponent) return std::nullopt;
  const unsigned long n = magnitude.get_ui();
  if (bit_size(base) * n > kMostRationalBits) return std::nullopt;
  // Powers of coprime numbers are coprime, so the result needs no reduction.
  Rational result;
  mpz_pow_ui(result.get_num_mpz_t(), base.get_num_mpz_t(), n);
  mpz_pow_ui(result.get_den_mpz_t(), base.get_den_mpz_t(), n);
  return sgn(exponent) > 0 ? result : Rational(1 / result);
}

std::optional<Rational> exact_root(const Rational& q, unsigned long k) {
  REQUIRES(k >= 1);
  Rational root;
  if (mpz_root(root.get_num_mpz_t(), q.get_num_mpz_t(), k) == 0) return std::nullopt;
  if (mpz_root(root.get_den_mpz_t(), q.get_den_mpz_t(), k) == 0) return std::nullopt;
  return root;
}

std::optional<Rational> exact_power(const Rational& base, const Rational& exponent) {
  if (is_integer(exponent)) return integer_power(base, exponent);
  if (sgn(base) < 0) return std::nullopt;
  if (sgn(base) == 0) return sgn(exponent) > 0 ? std::optional<Rational>(0) : std::nullopt;
  if (base == 1) return Rational(1);
  // A k-th power other than 0 and 1 has at least k bits.
  if (exponent.get_den() > bit_size(base)) return std::nullopt;
  const std::optional<Rational> root = exact_root(base, exponent.get_den().get_ui());
  return root ? integer_power(*root, Rational(exponent.get_num())) : std::nullopt;
}

}  // namespace coordreq
