#include "verify/flow_extremes.hpp"

#include <algorithm>

#include "base/requires.hpp"

namespace coordreq {
namespace {

constexpr int kMostTerms = 24;
/// The tail of a series need not be less than this, or than this part of what slopes leave open.
constexpr double kNegligible = 1e-17;
constexpr double kNegligibleFraction = 1e-4;

/// Its entry (i, j) is 0 if and only if i does not depend on j, not even by way of others.
ArbMatrix paths_in(const ArbMatrix& slopes, slong n) {
  ArbMatrix direct(static_cast<std::size_t>(n), static_cast<std::size_t>(n));
  for (slong i = 0; i < n; ++i) {
    for (slong j = 0; j < n; ++j) {
      const bool depends = i == j || arb_is_zero(arb_mat_entry(slopes.get(), i, j)) == 0;
      arb_set_ui(arb_mat_entry(direct.get(), i, j), depends ? 1 : 0);
    }
  }
  ArbMatrix paths = direct;
  arb_mat_pow_ui(paths.get(), direct.get(), static_cast<ulong>(n), kArbBits);
  return paths;
}

/// The widest entry.
double most_width(const ArbMatrix& a, slong n) {
  double most = 0.0;
  for (slong i = 0; i < n; ++i) {
    for (slong j = 0; j < n; ++j) most = std::max(most, mag_get_d(arb_radref(arb_mat_entry(a.get(), i, j))));
  }
  return 2 * most;
}

}  // namespace

ArbMatrix transition_matrix(const ArbMatrix& slopes, const Arb& duration) {
  REQUIRES(duration.is_nonnegative());
  const slong n = arb_mat_nrows(slopes.get());
  ArbMatrix sum(static_cast<std::size_t>(n), static_cast<std::size_t>(n));
  if (n == 1) {  // numbers commute: exp of the integral of A
    const Arb exponent = slopes(0, 0) * duration;
    arb_exp(sum.entry(0, 0), exponent.get(), kArbBits);
    return sum;
  }
  arb_mat_one(sum.get());
  ArbMatrix term = sum;
  Arb norm;  // of J h
  arb_mat_bound_inf_norm(arb_radref(norm.get()), slopes.get());
  norm = norm.upper() * duration.upper();
  const double open = most_width(slopes, n) * duration.upper().approximately();
  const double enough = std::max(kNegligible, kNegligibleFraction * open);
  Arb tail(1.0);  // |J h|^k / k!
  for (int k = 1; k <= kMostTerms && tail.upper().approximately() > enough; ++k) {
    const Arb share = duration / Arb(static_cast<double>(k));
    term = term * slopes;
    arb_mat_scalar_mul_arb(term.get(), term.get(), share.get(), kArbBits);
    arb_mat_add(sum.get(), sum.get(), term.get(), kArbBits);
    tail = tail * norm / Arb(static_cast<double>(k));
  }
  Arb growth;
  arb_exp(growth.get(), norm.get(), kArbBits);
  tail = tail * norm * growth;
  const Arb rest = hull(Arb() - tail, tail);
  const ArbMatrix paths = paths_in(slopes, n);
  for (slong i = 0; i < n; ++i) {
    for (slong j = 0; j < n; ++j) {
      arb_ptr entry = arb_mat_entry(sum.get(), i, j);
      if (arb_is_zero(arb_mat_entry(paths.get(), i, j)) == 0) arb_add(entry, entry, rest.get(), kArbBits);
    }
  }
  return sum;
}

}  // namespace coordreq
