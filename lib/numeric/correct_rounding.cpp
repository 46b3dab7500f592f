#include "numeric/correct_rounding.hpp"

#include <mpfr.h>

#include "base/requires.hpp"
#include "numeric/rational_functions.hpp"

namespace coordreq {
namespace {

constexpr mpfr_prec_t kFirstPrecision = 128;

/// A floating-point number of MPFR that frees itself.
class BigFloat {
 public:
  explicit BigFloat(mpfr_prec_t precision) { mpfr_init2(value_, precision); }
  ~BigFloat() { mpfr_clear(value_); }
  BigFloat(const BigFloat&) = delete;
  BigFloat& operator=(const BigFloat&) = delete;

  [[nodiscard]] mpfr_ptr get() { return value_; }
  [[nodiscard]] mpfr_srcptr get() const { return value_; }

 private:
  mpfr_t value_;
};

/// lower <= value <= upper.
struct Enclosure {
  explicit Enclosure(mpfr_prec_t precision) : lower(precision), upper(precision) {}
  Enclosure(const Rational& q, mpfr_prec_t precision) : Enclosure(precision) {
    mpfr_set_q(lower.get(), q.get_mpq_t(), MPFR_RNDD);
    mpfr_set_q(upper.get(), q.get_mpq_t(), MPFR_RNDU);
  }

  [[nodiscard]] bool is_point() const { return mpfr_equal_p(lower.get(), upper.get()) != 0; }

  /// The double that both ends round to, if it is one.
  [[nodiscard]] std::optional<double> rounded() const {
    const double below = mpfr_get_d(lower.get(), MPFR_RNDN);
    const double above = mpfr_get_d(upper.get(), MPFR_RNDN);
    // Adding zero turns -0 into 0.
    return below == above ? std::optional<double>(below + 0.0) : std::nullopt;
  }

  BigFloat lower;
  BigFloat upper;
};

using MpfrFunction = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);

MpfrFunction mpfr_function(ElementaryFunction f) {
  switch (f) {
    case ElementaryFunction::sine:
      return mpfr_sin;
    case ElementaryFunction::cosine:
      return mpfr_cos;
    case ElementaryFunction::tangent:
      return mpfr_tan;
    case ElementaryFunction::arcsine:
      return mpfr_asin;
    case ElementaryFunction::arccosine:
      return mpfr_acos;
    case ElementaryFunction::arctangent:
      return mpfr_atan;
    case ElementaryFunction::hyperbolic_sine:
      return mpfr_sinh;
    case ElementaryFunction::hyperbolic_cosine:
      return mpfr_cosh;
    case ElementaryFunction::hyperbolic_tangent:
      return mpfr_tanh;
    case ElementaryFunction::exponential:
      return mpfr_exp;
    case ElementaryFunction::logarithm:
      return mpfr_log;
    case ElementaryFunction::square_root:
      return mpfr_sqrt;
  }
  return nullptr;
}

bool is_defined(ElementaryFunction f, const Rational& q) {
  switch (f) {
    case ElementaryFunction::arcsine:
    case ElementaryFunction::arccosine:
      return abs(q) <= 1;
    case ElementaryFunction::logarithm:
      return sgn(q) > 0;
    case ElementaryFunction::square_root:
      return sgn(q) >= 0;
    default:
      return true;
  }
}

/// Whether `f` keeps its sign over the enclosure, which must be narrower than half a turn for that to be seen
/// at its ends.
bool keeps_sign(MpfrFunction f, const Enclosure& x) {
  constexpr mpfr_prec_t kPrecision = 64;
  BigFloat width(kPrecision);
  mpfr_sub(width.get(), x.upper.get(), x.lower.get(), MPFR_RNDU);
  if (mpfr_cmp_ui(width.get(), 1) > 0) return false;
  BigFloat first(kPrecision);
  BigFloat last(kPrecision);
  f(first.get(), x.lower.get(), MPFR_RNDN);
  f(last.get(), x.upper.get(), MPFR_RNDN);
  return mpfr_sgn(first.get()) * mpfr_sgn(last.get()) > 0;
}

/// Whether f has neither an extremum nor a pole within x, so that its values at the ends enclose the rest.
bool is_monotone(ElementaryFunction f, const Enclosure& x) {
  if (x.is_point()) return true;
  switch (f) {
    case ElementaryFunction::sine:
    case ElementaryFunction::tangent:
      return keeps_sign(mpfr_cos, x);
    case ElementaryFunction::cosine:
      return keeps_sign(mpfr_sin, x);
    default:
      return true;
  }
}

void widen(Enclosure& hull, const Enclosure& other) {
  mpfr_min(hull.lower.get(), hull.lower.get(), other.lower.get(), MPFR_RNDD);
  mpfr_max(hull.upper.get(), hull.upper.get(), other.upper.get(), MPFR_RNDU);
}

std::optional<double> rounded_at(ElementaryFunction f, const Rational& q, mpfr_prec_t precision) {
  const Enclosure x(q, precision);
  if (!is_monotone(f, x)) return std::nullopt;
  const MpfrFunction function = mpfr_function(f);
  Enclosure result(precision);
  function(result.lower.get(), x.lower.get(), MPFR_RNDD);
  function(result.upper.get(), x.lower.get(), MPFR_RNDU);
  Enclosure last(precision);
  function(last.lower.get(), x.upper.get(), MPFR_RNDD);
  function(last.upper.get(), x.upper.get(), MPFR_RNDU);
  widen(result, last);
  return result.rounded();
}

using MpfrFunctionOfTwo = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

/// f(a, b) for an f that over small boxes is extreme at corners: powers are monotone in either argument, and
/// seen from the origin the extreme points of a box are corners.
double rounded_at_corners(MpfrFunctionOfTwo f, const Rational& a, const Rational& b) {
  for (mpfr_prec_t precision = kFirstPrecision;; precision *= 2) {
    const Enclosure x(a, precision);
    const Enclosure y(b, precision);
    Enclosure result(precision);
    f(result.lower.get(), x.lower.get(), y.lower.get(), MPFR_RNDD);
    f(result.upper.get(), x.lower.get(), y.lower.get(), MPFR_RNDU);
    for (const BigFloat* const first : {&x.lower, &x.upper}) {
      for (const BigFloat* const second : {&y.lower, &y.upper}) {
        Enclosure corner(precision);
        f(corner.lower.get(), first->get(), second->get(), MPFR_RNDD);
        f(corner.upper.get(), first->get(), second->get(), MPFR_RNDU);
        widen(result, corner);
      }
    }
    if (const std::optional<double> value = result.rounded()) return *value;
  }
}

}  // namespace

std::optional<double> nearest_value(ElementaryFunction f, const Rational& q) {
  if (!is_defined(f, q)) return std::nullopt;
  for (mpfr_prec_t precision = kFirstPrecision;; precision *= 2) {
    if (const std::optional<double> value = rounded_at(f, q, precision)) return value;
  }
}

double nearest_power(const Rational& base, const Rational& exponent) {
  REQUIRES(sgn(base) > 0 && !is_integer(exponent) && !exact_power(base, exponent));
  return rounded_at_corners(mpfr_pow, base, exponent);
}

std::optional<double> nearest_angle(const Rational& y, const Rational& x) {
  REQUIRES(sgn(y) != 0 || sgn(x) <= 0);
  if (sgn(y) == 0 && sgn(x) == 0) return std::nullopt;
  return rounded_at_corners(mpfr_atan2, y, x);
}

}  // namespace coordreq
