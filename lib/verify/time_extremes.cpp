#include "verify/time_extremes.hpp"

#include <algorithm>

namespace coordreq {
namespace {

constexpr int kMostHalvings = 24;
constexpr int kSignHalvings = 6;

struct Range {
  Rational lower;
  Rational upper;
};

/// The coefficients of p(begin + s).
Polynomial moved(Polynomial p, const Rational& begin) {
  for (std::size_t done = 0; done + 1 < p.size(); ++done) {
    for (std::size_t k = p.size() - 1; k > done; --k) p[k - 1] += begin * p[k];
  }
  return p;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial result;
  for (std::size_t k = 1; k < p.size(); ++k) result.emplace_back(p[k] * Rational(static_cast<long>(k)));
  if (result.empty()) result.emplace_back(0);
  return result;
}

/// Encloses all values on [0, length], by Horner's rule: s times an interval is its hull with 0.
Range range_on(const Polynomial& p, const Rational& length) {
  Range sum{p.back(), p.back()};
  for (std::size_t k = p.size() - 1; k-- > 0;) {
    sum.lower = (sum.lower < 0 ? Rational(sum.lower * length) : Rational(0)) + p[k];
    sum.upper = (sum.upper > 0 ? Rational(sum.upper * length) : Rational(0)) + p[k];
  }
  return sum;
}

bool keeps_its_sign(const Range& range) {
  return range.lower >= 0 || range.upper <= 0;
}

/// Where `slope` has its root, if that is easily told and within the range, else the middle.
Rational turning_point(const Polynomial& slope, const Rational& length) {
  const bool linear = slope.size() >= 2 && slope[1] != 0 &&
                      std::all_of(slope.begin() + 2, slope.end(), [](const Rational& q) { return q == 0; });
  if (linear) {
    Rational root = -slope[0] / slope[1];
    if (root > 0 && root < length) return root;
  }
  return length / 2;
}

/// @param p begins at 0; its values at both ends are in `found`
void look_between(const Polynomial& p, const Rational& length, int halvings, FloorOfLeast& found) {
  const Polynomial slope = derivative(p);
  if (keeps_its_sign(range_on(slope, length))) return;
  const std::int64_t below = floor_to_int(range_on(p, length).lower);
  if (below >= found.inner) return;
  if (halvings == kMostHalvings) {
    found.outer = std::min(found.outer, below);
    return;
  }
  const Rational cut = turning_point(slope, length);
  const Polynomial rest = moved(p, cut);
  found.inner = std::min(found.inner, floor_to_int(rest.front()));
  look_between(p, cut, halvings + 1, found);
  look_between(rest, length - cut, halvings + 1, found);
}

int sign_between(const Polynomial& p, const Rational& length, int halvings) {
  const Range range = range_on(p, length);
  if (keeps_its_sign(range)) return range.lower >= 0 ? 1 : -1;
  if (halvings == kSignHalvings) return 0;
  const Rational half = length / 2;
  const int first = sign_between(p, half, halvings + 1);
  if (first == 0) return 0;
  const int second = sign_between(moved(p, half), half, halvings + 1);
  return first == second ? first : 0;
}

}  // namespace

Rational value_at(const Polynomial& p, const Rational& t) {
  Rational sum = 0;
  for (std::size_t k = p.size(); k-- > 0;) sum = sum * t + p[k];
  return sum;
}

int sign_on(const Polynomial& p, const Rational& end) {
  return sign_between(p, end, 0);
}

FloorOfLeast floor_of_least(const Polynomial& p, const Rational& end) {
  FloorOfLeast found;
  found.inner = std::min(floor_to_int(p.front()), floor_to_int(value_at(p, end)));
  found.outer = found.inner;
  look_between(p, end, 0, found);
  found.outer = std::min(found.outer, found.inner);
  return found;
}

}  // namespace coordreq
