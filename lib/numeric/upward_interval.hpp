#pragma once

#if !COORDREQ_ROUNDING_MATH
#error "sources that round upward are compiled for it: link coordreq_rounding_math"
#endif

#include <algorithm>
#include <cmath>

#include "numeric/interval.hpp"
#include "numeric/upward_rounding.hpp"

namespace coordreq {

/// An Interval whose ends are held as (-lower, upper), so that rounding both upward is rounding outward: one
/// instruction does the same for both ends, and nothing asks whether a result is exact. Its operations
/// enclose as those of Interval do, and are never wider: each end is the nearest double that encloses.
///
/// Only within rounded_upward(), but for making one and reading its ends. As in Interval ends may be
/// infinite, never NaN, lower < +infinity, upper > -infinity, and 0 times infinity is 0.
class UpwardInterval {
 public:
  /// {0}.
  UpwardInterval() = default;
  /// {value}.
  explicit UpwardInterval(double value) : ends_{-value, value} {}
  UpwardInterval(double lower, double upper) : ends_{-lower, upper} {}
  explicit UpwardInterval(const Interval& a) : UpwardInterval(a.lower, a.upper) {}

  [[nodiscard]] double lower() const { return -ends_[0]; }
  [[nodiscard]] double upper() const { return ends_[1]; }
  [[nodiscard]] Interval interval(bool total = true) const { return {lower(), upper(), total}; }
  /// The largest |x|.
  [[nodiscard]] double magnitude() const { return std::max(ends_[0], ends_[1]); }
  [[nodiscard]] bool is_zero() const { return ends_[0] == 0.0 && ends_[1] == 0.0; }
  [[nodiscard]] bool is_finite() const { return magnitude() <= outward::kLargest; }
  [[nodiscard]] bool contains_zero() const { return ends_[0] >= 0.0 && ends_[1] >= 0.0; }

  [[nodiscard]] friend UpwardInterval operator-(const UpwardInterval& a) {
    return UpwardInterval(swapped(a.ends_));
  }
  [[nodiscard]] friend UpwardInterval operator+(const UpwardInterval& a, const UpwardInterval& b) {
    return UpwardInterval(a.ends_ + b.ends_);
  }
  [[nodiscard]] friend UpwardInterval operator-(const UpwardInterval& a, const UpwardInterval& b) {
    return a + -b;
  }
  UpwardInterval& operator+=(const UpwardInterval& a) { return *this = *this + a; }

  /// The largest of what the products of ends come to, for each end of the result. A product that is NaN is
  /// one of 0 and infinity, and stands for 0: the first gives way to it, and the others may be left out as
  /// then 0 is among the rest.
  [[nodiscard]] friend UpwardInterval operator*(const UpwardInterval& a, const UpwardInterval& b) {
    const Pair first = lower_twice(a.ends_);
    const Pair second = upper_twice(a.ends_);
    const Pair other = swapped(b.ends_);
    const Pair result = larger(second * b.ends_, number_or_zero(first * other));
    return UpwardInterval(larger(-second * other, larger(-first * b.ends_, result)));
  }
  /// The same of {b}. @pre unchecked: b is finite
  [[nodiscard]] friend UpwardInterval operator*(const UpwardInterval& a, double b) {
    const Pair factor{b, b};
    return UpwardInterval(larger(swapped(a.ends_) * -factor, number_or_zero(a.ends_ * factor)));
  }

  /// @pre b does not contain 0
  [[nodiscard]] friend UpwardInterval operator/(const UpwardInterval& a, const UpwardInterval& b) {
    REQUIRES(!b.contains_zero());
    const Pair first = lower_twice(a.ends_);
    const Pair second = upper_twice(a.ends_);
    const Pair other = swapped(b.ends_);
    const Pair result = larger(second / b.ends_, number_or_zero(first / other));
    return UpwardInterval(larger(-second / other, larger(-first / b.ends_, result)));
  }

  /// {x^2}: unlike a * a it knows that both factors are the same.
  [[nodiscard]] friend UpwardInterval sqr(const UpwardInterval& a) {
    const double least = std::max({a.lower(), -a.upper(), 0.0});
    const double greatest = a.magnitude();
    return UpwardInterval(Pair{-least * least, greatest * greatest});
  }

  [[nodiscard]] friend UpwardInterval hull(const UpwardInterval& a, const UpwardInterval& b) {
    return UpwardInterval(larger(a.ends_, b.ends_));
  }
  [[nodiscard]] friend UpwardInterval hull_with_zero(const UpwardInterval& a) {
    return UpwardInterval(larger(a.ends_, Pair{0.0, 0.0}));
  }
  /// The points of both; `a` if there are none.
  [[nodiscard]] friend UpwardInterval intersection(const UpwardInterval& a, const UpwardInterval& b) {
    const UpwardInterval both(std::max(a.lower(), b.lower()), std::min(a.upper(), b.upper()));
    return both.lower() <= both.upper() ? both : a;
  }
  /// {max(x, 0)}, {min(x, 0)}.
  [[nodiscard]] friend UpwardInterval positive_part(const UpwardInterval& a) {
    return UpwardInterval(Pair{std::min(a.ends_[0], 0.0), std::max(a.ends_[1], 0.0)});
  }
  [[nodiscard]] friend UpwardInterval negative_part(const UpwardInterval& a) { return -positive_part(-a); }

 private:
  using Pair [[gnu::vector_size(2 * sizeof(double))]] = double;

  explicit UpwardInterval(Pair ends) : ends_(ends) {}

  static Pair swapped(Pair a) { return __builtin_shufflevector(a, a, 1, 0); }
  static Pair lower_twice(Pair a) { return __builtin_shufflevector(a, a, 0, 0); }
  static Pair upper_twice(Pair a) { return __builtin_shufflevector(a, a, 1, 1); }
  /// The second where either is NaN.
  static Pair larger(Pair a, Pair b) {
#if defined(__SSE2__)
    return __builtin_ia32_maxpd(a, b);
#else
    return a > b ? a : b;
#endif
  }
  static Pair number_or_zero(Pair a) {
    return a == a ? a : Pair{0.0, 0.0};
  }

  Pair ends_{0.0, 0.0};
};

}  // namespace coordreq
