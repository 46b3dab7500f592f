#include "reach/absolute_integral.hpp"

#include <algorithm>
#include <cstddef>

namespace coordreq {
namespace {

constexpr int kMaxDepth = 24;

/// De Casteljau at the middle: `b` becomes the left half, the right half is returned.
std::vector<Rational> split(std::vector<Rational>& b) {
  std::vector<Rational> right(b.size());
  std::vector<Rational> work = b;
  for (std::size_t level = 0; level < b.size(); ++level) {
    b[level] = work[0];
    right[b.size() - 1 - level] = work[b.size() - 1 - level];
    for (std::size_t i = 0; i + 1 < b.size() - level; ++i) work[i] = (work[i] + work[i + 1]) / 2;
  }
  return right;
}

AbsoluteIntegral integrate(std::vector<Rational> b, const Rational& width, int depth) {
  const bool none_negative = std::all_of(b.begin(), b.end(), [](const Rational& q) { return q >= 0; });
  const bool none_positive = std::all_of(b.begin(), b.end(), [](const Rational& q) { return q <= 0; });
  if (none_negative || none_positive) {
    Rational sum = 0;
    for (const Rational& q : b) sum += q;
    return {abs(sum) * width / Rational(static_cast<long>(b.size())), true};
  }
  if (depth == kMaxDepth) {
    Rational largest = 0;
    for (const Rational& q : b) largest = std::max(largest, Rational(abs(q)));
    return {largest * width, false};
  }
  std::vector<Rational> right = split(b);
  const AbsoluteIntegral first = integrate(std::move(b), width / 2, depth + 1);
  const AbsoluteIntegral second = integrate(std::move(right), width / 2, depth + 1);
  return {first.value + second.value, first.exact && second.exact};
}

}  // namespace

AbsoluteIntegral integral_of_absolute(const std::vector<Rational>& coefficient, const Rational& end) {
  if (coefficient.empty()) return {0, true};
  return integrate(to_bernstein(coefficient, end), end, 0);
}

}  // namespace coordreq
