#include "verify/switching_integral.hpp"

#include <algorithm>

#include "numeric/rational_interval.hpp"

namespace coordreq {
namespace {

constexpr int kMostHalvings = 24;

Rational antiderivative(const std::vector<Rational>& g, const Rational& s) {
  Rational sum = 0;
  for (std::size_t k = g.size(); k-- > 0;) sum = (sum + g[k] / Rational(static_cast<long>(k + 1))) * s;
  return sum;
}

/// The coefficients of g(begin + s).
std::vector<Rational> moved(std::vector<Rational> g, const Rational& begin) {
  for (std::size_t done = 0; done < g.size(); ++done) {
    for (std::size_t k = g.size() - 1; k > done; --k) g[k - 1] += begin * g[k];
  }
  return g;
}

/// All values on [begin, begin + length].
RationalInterval range_on(const std::vector<Rational>& g, const Rational& begin, const Rational& length) {
  const std::vector<Rational> local = moved(g, begin);
  const RationalInterval s{.lower = 0, .upper = length};
  RationalInterval sum{.lower = 0, .upper = 0};
  for (std::size_t k = local.size(); k-- > 0;)
    sum = sum * s + RationalInterval{.lower = local[k], .upper = local[k]};
  return sum;
}

void add_absolute(const std::vector<Rational>& g, const Rational& begin, const Rational& length, int halvings,
                  SwitchingIntegral& result) {
  const RationalInterval range = range_on(g, begin, length);
  if (range.lower >= 0 || range.upper <= 0) {
    result.absolute += abs(antiderivative(g, begin + length) - antiderivative(g, begin));
  } else if (halvings == kMostHalvings) {
    result.absolute += length * std::max(Rational(-range.lower), range.upper);
    result.exact = false;
  } else {
    const Rational half = length / 2;
    add_absolute(g, begin, half, halvings + 1, result);
    add_absolute(g, begin + half, half, halvings + 1, result);
  }
}

}  // namespace

SwitchingIntegral integrate_switching(const std::vector<Rational>& coefficient, const Rational& end) {
  SwitchingIntegral result{.plain = antiderivative(coefficient, end), .absolute = 0};
  if (!coefficient.empty()) add_absolute(coefficient, 0, end, 0, result);
  return result;
}

}  // namespace coordreq
