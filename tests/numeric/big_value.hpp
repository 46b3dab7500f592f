#pragma once

#include <mpfr.h>

namespace coordreq {

/// The exact value of a function between two neighbours of 200 bits, by MPFR: the reference of these tests.
class BigValue {
 public:
  BigValue() {
    mpfr_inits2(kPrecision, x_, y_, below_, above_, toward_zero_, static_cast<mpfr_ptr>(nullptr));
  }
  ~BigValue() { mpfr_clears(x_, y_, below_, above_, toward_zero_, static_cast<mpfr_ptr>(nullptr)); }
  BigValue(const BigValue&) = delete;
  BigValue& operator=(const BigValue&) = delete;

  using Unary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
  using Binary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

  void set(Unary function, double x) {
    mpfr_set_d(x_, x, MPFR_RNDN);
    function(below_, x_, MPFR_RNDD);
    function(above_, x_, MPFR_RNDU);
    function(toward_zero_, x_, MPFR_RNDZ);
  }
  void set(Binary function, double x, double y) {
    mpfr_set_d(x_, x, MPFR_RNDN);
    mpfr_set_d(y_, y, MPFR_RNDN);
    function(below_, x_, y_, MPFR_RNDD);
    function(above_, x_, y_, MPFR_RNDU);
    function(toward_zero_, x_, y_, MPFR_RNDZ);
  }

  /// Not at a pole and not outside the domain. (A value that merely overflows rounds to a finite number
  /// here.)
  [[nodiscard]] bool is_defined() const { return mpfr_number_p(toward_zero_) != 0; }
  [[nodiscard]] bool is_at_least(double bound) const { return mpfr_cmp_d(below_, bound) >= 0; }
  [[nodiscard]] bool is_at_most(double bound) const { return mpfr_cmp_d(above_, bound) <= 0; }
  /// The double nearest to the value. REQUIRES: it is no tie to 200 bits.
  [[nodiscard]] double nearest() const { return mpfr_get_d(below_, MPFR_RNDN); }

 private:
  static constexpr mpfr_prec_t kPrecision = 200;
  mpfr_t x_;
  mpfr_t y_;
  mpfr_t below_;
  mpfr_t above_;
  mpfr_t toward_zero_;
};

}  // namespace coordreq
