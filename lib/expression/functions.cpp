#include "expression/functions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/requires.hpp"
#include "expression/dual.hpp"
#include "numeric/correct_rounding.hpp"
#include "numeric/rational_functions.hpp"

namespace coordreq {
namespace {

using Index = NodeWriter::Index;
using Outcome = Constant::Outcome;

// Adapters, so that a row can name a function of each number type.

template <double (*f)(double)>
double at(const double& a, const double& /*b*/) {
  return f(a);
}
template <class T, T (*f)(const T&)>
T of(const T& a, const T& /*b*/) {
  return f(a);
}
template <class T, T (*f)(const T&, const T&)>
T of_both(const T& a, const T& b) {
  return f(a, b);
}
template <class T>
T plus(const T& a, const T& b) {
  return a + b;
}
template <class T>
T minus(const T& a, const T& b) {
  return a - b;
}
template <class T>
T times(const T& a, const T& b) {
  return a * b;
}
template <class T>
T quotient(const T& a, const T& b) {
  return a / b;
}
template <class T>
T minus_a(const T& a, const T& /*b*/) {
  return -a;
}
/// An irrational function of an exact interval; sin(0), exp(0) and the like stay exact, since Interval gives
/// them as points.
template <Interval (*f)(const Interval&)>
RationalInterval outward(const RationalInterval& a, const RationalInterval& /*b*/) {
  return to_rational(f(enclose(a)));
}
template <Interval (*f)(const Interval&, const Interval&)>
RationalInterval outward_of_both(const RationalInterval& a, const RationalInterval& b) {
  return to_rational(f(enclose(a), enclose(b)));
}

// Double arithmetic: NaN where undefined.

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

double divide_doubles(const double& a, const double& b) {
  return b == 0.0 ? kUndefined : a / b;
}
double double_power(const double& a, const double& b) {
  if (std::isnan(a) || std::isnan(b)) return kUndefined;
  if (b == 2.0) return a * a;
  if (a == 0.0 && b < 0.0) return kUndefined;
  return std::pow(a, b);
}
double smaller(const double& a, const double& b) {
  return std::isnan(b) || b < a ? b : a;
}
double greater(const double& a, const double& b) {
  return std::isnan(b) || b > a ? b : a;
}
double double_log(double a) {
  return a > 0.0 ? std::log(a) : kUndefined;
}
/// Without a -0 that would choose the side of the cut.
double double_angle(const double& y, const double& x) {
  return y == 0.0 && x == 0.0 ? kUndefined : std::atan2(y + 0.0, x + 0.0);
}
double double_sign(double a) {
  if (std::isnan(a)) return a;
  return a > 0.0 ? 1.0 : a < 0.0 ? -1.0 : 0.0;
}

// Constants.

std::optional<Rational> within_limit(const Rational& q) {
  return bit_size(q) <= kMostRationalBits ? std::optional<Rational>(q) : std::nullopt;
}
template <Rational (*f)(const Rational&, const Rational&)>
std::optional<Rational> exactly(const Rational& a, const Rational& b) {
  return within_limit(f(a, b));
}
std::optional<Rational> lesser_rational(const Rational& a, const Rational& b) {
  return a < b ? a : b;
}
std::optional<Rational> greater_rational(const Rational& a, const Rational& b) {
  return a < b ? b : a;
}
std::optional<Rational> negated(const Rational& a, const Rational& /*b*/) {
  return Rational(-a);
}
std::optional<Rational> magnitude(const Rational& a, const Rational& /*b*/) {
  return Rational(abs(a));
}
std::optional<Rational> sign_of(const Rational& a, const Rational& /*b*/) {
  return Rational(sgn(a));
}
std::optional<Rational> floor_of(const Rational& a, const Rational& /*b*/) {
  return floor(a);
}
std::optional<Rational> no_angle(const Rational& y, const Rational& x) {
  return sgn(y) == 0 && sgn(x) > 0 ? std::optional<Rational>(0) : std::nullopt;
}
/// The function is `value` at `point`, and irrational at all other rationals.
template <int point, int value>
std::optional<Rational> rational_only_at(const Rational& a, const Rational& /*b*/) {
  return a == point ? std::optional<Rational>(value) : std::nullopt;
}
std::optional<Rational> exact_quotient(const Rational& a, const Rational& b) {
  return sgn(b) == 0 ? std::nullopt : within_limit(a / b);
}
std::optional<Rational> exact_square_root(const Rational& a, const Rational& /*b*/) {
  return sgn(a) < 0 ? std::nullopt : exact_root(a, 2);
}

Constant from_double(double value) {
  if (!std::isfinite(value)) return {Outcome::not_finite, 0};
  return {Outcome::value, exact(value)};
}
/// Longer arguments take long to round correctly, and no one means them.
constexpr std::size_t kMostRoundedBits = 4096;

template <ElementaryFunction f>
Constant to_double(const Rational& a, const Rational& /*b*/) {
  if (bit_size(a) > kMostRoundedBits) return {Outcome::too_large, 0};
  const std::optional<double> value = nearest_value(f, a);
  return value ? from_double(*value) : Constant{};
}
Constant angle_constant(const Rational& y, const Rational& x) {
  if (std::max(bit_size(y), bit_size(x)) > kMostRoundedBits) return {Outcome::too_large, 0};
  const std::optional<double> value = nearest_angle(y, x);
  return value ? from_double(*value) : Constant{};
}
template <Outcome outcome>
Constant none(const Rational& /*a*/, const Rational& /*b*/) {
  return {outcome, 0};
}
Constant quotient_constant(const Rational& a, const Rational& b) {
  if (sgn(b) != 0) return {Outcome::too_large, 0};
  return {sgn(a) == 0 ? Outcome::undefined : Outcome::zero_divisor, 0};
}
Constant power_constant(const Rational& a, const Rational& b) {
  if (sgn(a) == 0) return {Outcome::zero_divisor, 0};  // 0^b with b < 0
  if (sgn(a) < 0 && !is_integer(b)) return {Outcome::undefined, 0};
  if (is_integer(b) || std::max(bit_size(a), bit_size(b)) > kMostRoundedBits) return {Outcome::too_large, 0};
  return from_double(nearest_power(a, b));
}

// Factors of series.

template <Operator op>
Index partner(NodeWriter& nodes, Index a, Index /*r*/) {
  return nodes.put_operation(op, a);
}
Index minus_sine(NodeWriter& nodes, Index a, Index /*r*/) {
  return nodes.put_operation(Operator::negate, nodes.put_operation(Operator::sine, a));
}
/// 1 + r^2 or 1 - r^2.
template <Operator plus_or_minus>
Index one_and_square(NodeWriter& nodes, Index /*a*/, Index r) {
  const Index one = nodes.put_number(1);
  return nodes.put_operation(plus_or_minus, one, nodes.put_operation(Operator::multiply, r, r));
}
/// 1 + a^2.
Index one_and_square(NodeWriter& nodes, Index a, Index /*r*/) {
  const Index one = nodes.put_number(1);
  return nodes.put_operation(Operator::add, one, nodes.put_operation(Operator::multiply, a, a));
}
/// sqrt(1 - a^2).
Index cosine_of_arcsine(NodeWriter& nodes, Index a, Index /*r*/) {
  const Index square = nodes.put_operation(Operator::multiply, a, a);
  const Index difference = nodes.put_operation(Operator::subtract, nodes.put_number(1), square);
  return nodes.put_operation(Operator::square_root, difference);
}
Index minus_cosine_of_arcsine(NodeWriter& nodes, Index a, Index r) {
  return nodes.put_operation(Operator::negate, cosine_of_arcsine(nodes, a, r));
}
Index itself(NodeWriter& /*nodes*/, Index /*a*/, Index r) {
  return r;
}
Index argument(NodeWriter& /*nodes*/, Index a, Index /*r*/) {
  return a;
}

constexpr std::size_t kAnyNumber = NumberFunction::kAnyNumber;
constexpr const char* kNowhere = "";
constexpr int kNever = NumberFunction::kNever;

// Operation, spelling, call, fewest and most arguments; over doubles, intervals, exact intervals, duals;
// exact and rounded constant; series, where undefined, half turns. None may be left out: see
// is_complete().
// clang-format off
constexpr std::array kFunctions{
    NumberFunction{Operator::add, "+", "", 2, 2,
        plus<double>, plus<Interval>, plus<RationalInterval>, plus<Dual>,
        exactly<plus<Rational>>, none<Outcome::too_large>,
        {SeriesRule::sum, nullptr}, kNowhere, kNever},
    NumberFunction{Operator::subtract, "-", "", 2, 2,
        minus<double>, minus<Interval>, minus<RationalInterval>, minus<Dual>,
        exactly<minus<Rational>>, none<Outcome::too_large>,
        {SeriesRule::difference, nullptr}, kNowhere, kNever},
    NumberFunction{Operator::multiply, "*", "", 2, 2,
        times<double>, times<Interval>, times<RationalInterval>, times<Dual>,
        exactly<times<Rational>>, none<Outcome::too_large>,
        {SeriesRule::product, nullptr}, kNowhere, kNever},
    NumberFunction{Operator::divide, "/", "", 2, 2,
        divide_doubles, quotient<Interval>, quotient<RationalInterval>, quotient<Dual>,
        exact_quotient, quotient_constant,
        {SeriesRule::quotient, nullptr}, "division by {1}", kNever},
    NumberFunction{Operator::power, "^", "pow", 2, 2,
        double_power, of_both<Interval, pow>, of_both<RationalInterval, pow>, of_both<Dual, pow>,
        exact_power, power_constant,
        {SeriesRule::power, nullptr}, "{0} to the power of {1}", kNever},
    NumberFunction{Operator::angle, "atan2", "atan2", 2, 2,
        double_angle, of_both<Interval, atan2>, outward_of_both<atan2>, of_both<Dual, atan2>,
        no_angle, angle_constant,
        {SeriesRule::angle, nullptr}, "atan2 of {0} and {1}", kNever},
    NumberFunction{Operator::minimum, "min", "min", 2, kAnyNumber,
        smaller, of_both<Interval, min>, of_both<RationalInterval, min>, of_both<Dual, min>,
        lesser_rational, none<Outcome::undefined>,
        {SeriesRule::pick, nullptr}, kNowhere, kNever},
    NumberFunction{Operator::maximum, "max", "max", 2, kAnyNumber,
        greater, of_both<Interval, max>, of_both<RationalInterval, max>, of_both<Dual, max>,
        greater_rational, none<Outcome::undefined>,
        {SeriesRule::pick, nullptr}, kNowhere, kNever},
    NumberFunction{Operator::negate, "-", "", 1, 1,
        minus_a<double>, minus_a<Interval>, minus_a<RationalInterval>, minus_a<Dual>,
        negated, none<Outcome::undefined>,
        {SeriesRule::negation, nullptr}, kNowhere, kNever},
    NumberFunction{Operator::sine, "sin", "sin", 1, 1,
        at<std::sin>, of<Interval, sin>, outward<sin>, of<Dual, sin>,
        rational_only_at<0, 0>, to_double<ElementaryFunction::sine>,
        {SeriesRule::chain, partner<Operator::cosine>}, kNowhere, 2},
    NumberFunction{Operator::cosine, "cos", "cos", 1, 1,
        at<std::cos>, of<Interval, cos>, outward<cos>, of<Dual, cos>,
        rational_only_at<0, 1>, to_double<ElementaryFunction::cosine>,
        {SeriesRule::chain, minus_sine}, kNowhere, 2},
    NumberFunction{Operator::tangent, "tan", "tan", 1, 1,
        at<std::tan>, of<Interval, tan>, outward<tan>, of<Dual, tan>,
        rational_only_at<0, 0>, to_double<ElementaryFunction::tangent>,
        {SeriesRule::chain, one_and_square<Operator::add>}, "tan of {0}", 1},
    NumberFunction{Operator::arcsine, "asin", "asin", 1, 1,
        at<std::asin>, of<Interval, asin>, outward<asin>, of<Dual, asin>,
        rational_only_at<0, 0>, to_double<ElementaryFunction::arcsine>,
        {SeriesRule::inverse_chain, cosine_of_arcsine}, "asin of {0}", kNever},
    NumberFunction{Operator::arccosine, "acos", "acos", 1, 1,
        at<std::acos>, of<Interval, acos>, outward<acos>, of<Dual, acos>,
        rational_only_at<1, 0>, to_double<ElementaryFunction::arccosine>,
        {SeriesRule::inverse_chain, minus_cosine_of_arcsine}, "acos of {0}", kNever},
    NumberFunction{Operator::arctangent, "atan", "atan", 1, 1,
        at<std::atan>, of<Interval, atan>, outward<atan>, of<Dual, atan>,
        rational_only_at<0, 0>, to_double<ElementaryFunction::arctangent>,
        {SeriesRule::inverse_chain, one_and_square}, kNowhere, kNever},
    NumberFunction{Operator::hyperbolic_sine, "sinh", "sinh", 1, 1,
        at<std::sinh>, of<Interval, sinh>, outward<sinh>, of<Dual, sinh>,
        rational_only_at<0, 0>, to_double<ElementaryFunction::hyperbolic_sine>,
        {SeriesRule::chain, partner<Operator::hyperbolic_cosine>}, kNowhere, kNever},
    NumberFunction{Operator::hyperbolic_cosine, "cosh", "cosh", 1, 1,
        at<std::cosh>, of<Interval, cosh>, outward<cosh>, of<Dual, cosh>,
        rational_only_at<0, 1>, to_double<ElementaryFunction::hyperbolic_cosine>,
        {SeriesRule::chain, partner<Operator::hyperbolic_sine>}, kNowhere, kNever},
    NumberFunction{Operator::hyperbolic_tangent, "tanh", "tanh", 1, 1,
        at<std::tanh>, of<Interval, tanh>, outward<tanh>, of<Dual, tanh>,
        rational_only_at<0, 0>, to_double<ElementaryFunction::hyperbolic_tangent>,
        {SeriesRule::chain, one_and_square<Operator::subtract>}, kNowhere, kNever},
    NumberFunction{Operator::exponential, "exp", "exp", 1, 1,
        at<std::exp>, of<Interval, exp>, outward<exp>, of<Dual, exp>,
        rational_only_at<0, 1>, to_double<ElementaryFunction::exponential>,
        {SeriesRule::chain, itself}, kNowhere, kNever},
    NumberFunction{Operator::logarithm, "log", "log", 1, 1,
        at<double_log>, of<Interval, log>, outward<log>, of<Dual, log>,
        rational_only_at<1, 0>, to_double<ElementaryFunction::logarithm>,
        {SeriesRule::inverse_chain, argument}, "logarithm of {0}", kNever},
    NumberFunction{Operator::square_root, "sqrt", "sqrt", 1, 1,
        at<std::sqrt>, of<Interval, sqrt>, of<RationalInterval, sqrt>, of<Dual, sqrt>,
        exact_square_root, to_double<ElementaryFunction::square_root>,
        {SeriesRule::root, nullptr}, "square root of {0}", kNever},
    NumberFunction{Operator::absolute, "abs", "abs", 1, 1,
        at<std::fabs>, of<Interval, abs>, of<RationalInterval, abs>, of<Dual, abs>,
        magnitude, none<Outcome::undefined>,
        {SeriesRule::pick, nullptr}, kNowhere, kNever},
    NumberFunction{Operator::sign, "sign", "sign", 1, 1,
        at<double_sign>, of<Interval, sign>, of<RationalInterval, sign>, of<Dual, sign>,
        sign_of, none<Outcome::undefined>,
        {SeriesRule::pick, nullptr}, kNowhere, kNever},
    NumberFunction{Operator::floor, "floor", "floor", 1, 1,
        at<std::floor>, of<Interval, floor>, of<RationalInterval, floor>, of<Dual, floor>,
        floor_of, none<Outcome::undefined>,
        {SeriesRule::pick, nullptr}, kNowhere, kNever},
};
// clang-format on

constexpr std::size_t index_of(Operator op) {
  return static_cast<std::size_t>(op) - static_cast<std::size_t>(Operator::add);
}

/// Whether a row has all of its columns.
[[maybe_unused]] constexpr bool is_complete(const NumberFunction& f) {
  const bool has_factor = f.series.rule == SeriesRule::chain || f.series.rule == SeriesRule::inverse_chain;
  return !f.spelling.empty() && f.fewest > 0 && f.most >= f.fewest && f.at_point != nullptr &&
         f.on_interval != nullptr && f.on_rationals != nullptr && f.on_dual != nullptr &&
         f.exactly != nullptr && f.rounded != nullptr && f.series.rule != SeriesRule::fixed &&
         (f.series.factor != nullptr) == has_factor && f.undefined != nullptr && f.half_turns != 0;
}

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < kFunctions.size(); ++i) {
    if (index_of(kFunctions[i].op) != i) return false;
  }
  return kFunctions.size() == index_of(Operator::floor) + 1;
}
static_assert(is_in_order());
// With its sanitisers g++ 12 takes no address of a function for a constant.
#if !defined(__SANITIZE_ADDRESS__)
static_assert(std::all_of(kFunctions.begin(), kFunctions.end(), is_complete));
#endif

}  // namespace

std::span<const NumberFunction> number_functions() {
  return kFunctions;
}

const NumberFunction& number_function(Operator op) {
  REQUIRES(is_number_function(op));
  return kFunctions[index_of(op)];
}

}  // namespace coordreq
