#include "numeric/interval.hpp"

#include "base/requires.hpp"

namespace coordreq {
namespace {

using outward::kInfinity;
using outward::kLargest;
using outward::moved;

/// The elementary functions of glibc are off by at most 2 units in the last place (its manual, "Errors in
/// Math Functions"), other libraries by a little more. Eight doubles are at least four such units also where
/// the enclosure crosses a power of two and doubles get twice as dense.
constexpr std::int64_t kLibraryError = 8;

constexpr Interval kPi{0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1};
constexpr Interval kTwoPi{0x1.921fb54442d18p+2, 0x1.921fb54442d19p+2};
constexpr double kHalfPiAbove = 0x1.921fb54442d19p+0;
/// Beyond this an enclosure of the number of turns is too wide to be of use.
constexpr double kMostReduced = 1e15;

double value_below(double library_value) {
  return moved(library_value, -kLibraryError);
}
double value_above(double library_value) {
  return moved(library_value, kLibraryError);
}

/// An enclosure of f(x) for the value that the library gives; f(0) = 0 is exact.
Interval around(double x, double library_value) {
  if (x == 0.0 && library_value == 0.0) return {0.0, 0.0};
  return {value_below(library_value), value_above(library_value)};
}

Interval clipped(const Interval& a, double least, double greatest) {
  return {std::clamp(a.lower, least, greatest), std::clamp(a.upper, least, greatest), a.total};
}

/// f over a, for an increasing f.
template <class Function>
Interval increasing(const Interval& a, Function function) {
  return {function(a.lower).lower, function(a.upper).upper, a.total};
}

bool may_contain_integer(const Interval& a) {
  return std::floor(a.upper) >= a.lower;
}

bool can_count_turns(const Interval& a, double period) {
  return a.upper - a.lower < period && a.lower >= -kMostReduced && a.upper <= kMostReduced;
}

bool is_finite_point(const Interval& a) {
  return a.is_point() && std::fabs(a.lower) <= kLargest;
}

/// sin and cos over a. `turns_to_top` is the fraction of a turn by which `a` has to be shifted so that the
/// maxima come to lie on whole turns; the minima are half a turn on.
template <class Function>
Interval wave(const Interval& a, Function value_at, double turns_to_top) {
  if (is_finite_point(a)) return {value_at(a.lower).lower, value_at(a.lower).upper, a.total};
  if (!can_count_turns(a, kTwoPi.lower)) return {-1.0, 1.0, a.total};
  const Interval turns = a / kTwoPi + Interval{turns_to_top, turns_to_top};
  const bool top = may_contain_integer(turns);
  const bool bottom = may_contain_integer(turns + Interval{0.5, 0.5});
  const Interval first = value_at(a.lower);
  const Interval last = value_at(a.upper);
  return {bottom ? -1.0 : std::min(first.lower, last.lower), top ? 1.0 : std::max(first.upper, last.upper),
          a.total};
}

bool is_integer_value(double x) {
  return std::fabs(x) <= kLargest && std::floor(x) == x;
}

/// x^y for one pair, x >= 0; where an argument is infinite, or a negative power of 0, as a limit.
Interval power_at(double x, double y) {
  if (y == 0.0 || x == 1.0) return {1.0, 1.0};
  if (x == 0.0) return y > 0.0 ? Interval{0.0, 0.0} : Interval{kLargest, kInfinity};
  if (y == 1.0) return {x, x};
  const double value = std::pow(x, y);
  return {std::max(0.0, value_below(value)), value_above(value)};
}

/// x^n by multiplication, which keeps exact results exact. @pre x >= 0, n >= 1
template <double (*multiply)(double, double)>
double multiplied(double x, unsigned n) {
  REQUIRES(x >= 0.0 && n >= 1);
  double result = 1.0;
  for (; n > 0; n /= 2) {
    if (n % 2 == 1) result = multiply(result, x);
    if (n > 1) x = multiply(x, x);
  }
  return result;
}

constexpr double kMostMultiplied = 64;
/// Up to here multiplication is at least as tight as the library.
constexpr double kMostTight = 8;

double power_down(double x, double n) {
  if (n > kMostMultiplied) return power_at(x, n).lower;
  const double product = multiplied<outward::multiply_down>(x, static_cast<unsigned>(n));
  return n <= kMostTight ? product : std::max(product, power_at(x, n).lower);
}
double power_up(double x, double n) {
  if (n > kMostMultiplied) return power_at(x, n).upper;
  const double product = multiplied<outward::multiply_up>(x, static_cast<unsigned>(n));
  return n <= kMostTight ? product : std::min(product, power_at(x, n).upper);
}

/// @pre n >= 1
Interval positive_power(const Interval& a, double n) {
  REQUIRES(n >= 1.0);
  const bool even = std::fmod(n, 2.0) == 0.0;
  if (even || a.lower >= 0.0) {
    const Interval magnitude = abs(a);
    return {power_down(magnitude.lower, n), power_up(magnitude.upper, n), a.total};
  }
  if (a.upper <= 0.0) return {-power_up(-a.lower, n), -power_down(-a.upper, n), a.total};
  return {-power_up(-a.lower, n), power_up(a.upper, n), a.total};
}

/// a^b over a >= 0: y log x over a box is extreme at a corner. Not total if 0 meets a negative exponent.
Interval power_of_nonnegative(const Interval& a, Interval b) {
  bool total = a.total && b.total;
  if (a.lower == 0.0 && b.lower < 0.0) {
    if (a.upper == 0.0 && b.upper < 0.0) return whole_line(false);
    total = false;
  }
  if (a.upper == 0.0) b.lower = std::max(b.lower, 0.0);
  const Interval corners[4] = {power_at(a.lower, b.lower), power_at(a.lower, b.upper),
                               power_at(a.upper, b.lower), power_at(a.upper, b.upper)};
  Interval result = corners[0];
  for (const Interval& corner : corners) result = hull(result, corner);
  result.total = total;
  return result;
}

}  // namespace

Interval enclose(const Rational& q) {
  const double below = lower_double(q);
  const double above = upper_double(q);
  return {below, above, true};
}

Interval divide_by_zero(const Interval& a, const Interval& b) {
  REQUIRES(b.contains(0.0));
  using outward::divide_down;
  using outward::divide_up;
  if (b.is_point()) return whole_line(false);
  if (a.lower == 0.0 && a.upper == 0.0) return {0.0, 0.0, false};
  const bool from_above = b.lower == 0.0;
  const bool from_below = b.upper == 0.0;
  if (from_above && a.lower >= 0.0) return {divide_down(a.lower, b.upper), kInfinity, false};
  if (from_above && a.upper <= 0.0) return {-kInfinity, divide_up(a.upper, b.upper), false};
  if (from_below && a.lower >= 0.0) return {-kInfinity, divide_up(a.lower, b.lower), false};
  if (from_below && a.upper <= 0.0) return {divide_down(a.upper, b.lower), kInfinity, false};
  return whole_line(false);
}

Interval sqrt(const Interval& a) {
  if (a.upper < 0.0) return whole_line(false);
  return {outward::square_root_down(std::max(a.lower, 0.0)), outward::square_root_up(a.upper),
          a.total && a.lower >= 0.0};
}

Interval power(const Interval& a, double n) {
  REQUIRES(is_integer_value(n));
  if (n == 0.0) return {1.0, 1.0, a.total};
  if (n == 2.0) return sqr(a);
  if (n > 0.0) return positive_power(a, n);
  if (a.lower == 0.0 && a.upper == 0.0) return whole_line(false);
  Interval result = Interval{1.0, 1.0} / positive_power(a, -n);
  // A positive power that underflows must not look like a division by zero.
  result.total = a.total && !a.contains(0.0);
  return result;
}

Interval pow(const Interval& a, const Interval& b) {
  if (b.is_point() && is_integer_value(b.lower)) {
    Interval result = power(a, b.lower);
    result.total = result.total && b.total;
    return result;
  }
  if (b.lower == 0.5 && b.upper == 0.5) {
    Interval result = sqrt(a);
    result.total = result.total && b.total;
    return result;
  }
  if (a.lower >= 0.0) return power_of_nonnegative(a, b);
  // x^n = +-|x|^n at the integers that b may contain, and nothing in between, where a is negative.
  const bool has_integer = may_contain_integer(b);
  if (!has_integer && a.upper < 0.0) return whole_line(false);
  const Interval magnitude = has_integer ? abs(a) : Interval{0.0, a.upper, a.total};
  Interval result = power_of_nonnegative(magnitude, b);
  result.total = false;
  return has_integer ? hull(result, -result) : result;
}

Interval exp(const Interval& a) {
  const auto value_at = [](double x) {
    if (x == 0.0) return Interval{1.0, 1.0};
    const double value = std::exp(x);
    return clipped({value_below(value), value_above(value)}, x > 0.0 ? 1.0 : 0.0, x < 0.0 ? 1.0 : kInfinity);
  };
  return increasing(a, value_at);
}

Interval log(const Interval& a) {
  if (a.upper <= 0.0) return whole_line(false);
  const auto value_at = [](double x) {
    if (x <= 0.0) return Interval{-kInfinity, -kInfinity};
    if (x == 1.0) return Interval{0.0, 0.0};
    return around(x, std::log(x));
  };
  return {value_at(a.lower).lower, value_at(a.upper).upper, a.total && a.lower > 0.0};
}

Interval sin(const Interval& a) {
  const auto value_at = [](double x) { return clipped(around(x, std::sin(x)), -1.0, 1.0); };
  return wave(a, value_at, -0.25);
}

Interval cos(const Interval& a) {
  const auto value_at = [](double x) {
    return x == 0.0 ? Interval{1.0, 1.0} : clipped(around(x, std::cos(x)), -1.0, 1.0);
  };
  return wave(a, value_at, 0.0);
}

Interval tan(const Interval& a) {
  const auto value_at = [](double x) { return around(x, std::tan(x)); };
  // No double is a pole, but a pole between two doubles must not be missed.
  if (is_finite_point(a)) return increasing(a, value_at);
  if (!can_count_turns(a, kPi.lower)) return whole_line(false);
  if (may_contain_integer(a / kPi + Interval{0.5, 0.5})) return whole_line(false);
  return increasing(a, value_at);
}

Interval asin(const Interval& a) {
  const std::optional<Interval> inside = intersect(a, {-1.0, 1.0});
  if (!inside) return whole_line(false);
  const auto value_at = [](double x) { return around(x, std::asin(x)); };
  Interval result = clipped(increasing(*inside, value_at), -kHalfPiAbove, kHalfPiAbove);
  result.total = a.total && a.lower >= -1.0 && a.upper <= 1.0;
  return result;
}

Interval acos(const Interval& a) {
  const std::optional<Interval> inside = intersect(a, {-1.0, 1.0});
  if (!inside) return whole_line(false);
  const double below = inside->upper == 1.0 ? 0.0 : value_below(std::acos(inside->upper));
  const double above = inside->lower == 1.0 ? 0.0 : value_above(std::acos(inside->lower));
  return {std::max(below, 0.0), std::min(above, kPi.upper), a.total && a.lower >= -1.0 && a.upper <= 1.0};
}

Interval atan(const Interval& a) {
  const auto value_at = [](double x) { return around(x, std::atan(x)); };
  return clipped(increasing(a, value_at), -kHalfPiAbove, kHalfPiAbove);
}

/// Seen from the origin the extreme points of a box are corners. Adding 0 makes 0 of -0, which would choose a
/// side of the cut.
Interval atan2(const Interval& y, const Interval& x) {
  if (y.is_zero() && x.is_zero()) return whole_line(false);
  const bool total = y.total && x.total && !(y.contains(0.0) && x.contains(0.0));
  if (meets_cut_of_angles(y, x)) return {-kPi.upper, kPi.upper, total};
  Interval result{kInfinity, -kInfinity, total};
  for (const double up : {y.lower, y.upper}) {
    for (const double right : {x.lower, x.upper}) {
      if (up == 0.0 && right == 0.0) continue;
      const Interval corner = around(up, std::atan2(up + 0.0, right + 0.0));
      result = {std::min(result.lower, corner.lower), std::max(result.upper, corner.upper), total};
    }
  }
  return clipped(result, -kPi.upper, kPi.upper);
}

Interval sinh(const Interval& a) {
  return increasing(a, [](double x) { return around(x, std::sinh(x)); });
}

Interval cosh(const Interval& a) {
  const auto value_at = [](double x) {
    return x == 0.0 ? Interval{1.0, 1.0} : clipped(around(x, std::cosh(x)), 1.0, kInfinity);
  };
  return increasing(abs(a), value_at);
}

Interval tanh(const Interval& a) {
  return clipped(increasing(a, [](double x) { return around(x, std::tanh(x)); }), -1.0, 1.0);
}

}  // namespace coordreq
