#pragma once

#include <mpfr.h>

namespace coordreq {

/// The exact value of a function between two neighbours of 128 bits, by MPFR: the reference of these tests.
class BigValue {
 public:
  BigValue() { mpfr_inits2(kPrecision, x_, y_, below_, above_, static_cast<mpfr_ptr>(nullptr)); }
  ~BigValue() { mpfr_clears(x_, y_, below_, above_, static_cast<mpfr_ptr>(nullptr)); }
  BigValue(const BigValue&) = delete;
  BigValue& operator=(const BigValue&) = delete;

  using Unary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
  using Binary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

  void set(Unary function, double x) {
    mpfr_set_d(x_, x, MPFR_RNDN);
    set_neighbours(function(below_, x_, MPFR_RNDZ));
  }
  void set(Binary function, double x, double y) {
    mpfr_set_d(x_, x, MPFR_RNDN);
    mpfr_set_d(y_, y, MPFR_RNDN);
    set_neighbours(function(below_, x_, y_, MPFR_RNDZ));
  }

  /// Not at a pole and not outside the domain. (A value that merely overflows rounds to a finite number
  /// here.)
  [[nodiscard]] bool is_defined() const { return defined_; }
  [[nodiscard]] bool is_at_least(double bound) const { return mpfr_cmp_d(below_, bound) >= 0; }
  [[nodiscard]] bool is_at_most(double bound) const { return mpfr_cmp_d(above_, bound) <= 0; }
  /// The double nearest to the value. REQUIRES: it is no tie to 128 bits.
  [[nodiscard]] double nearest() const { return mpfr_get_d(below_, MPFR_RNDN); }

 private:
  static constexpr mpfr_prec_t kPrecision = 128;

  /// @param direction sign of rounded - exact for the value in `below_`, which was rounded toward zero
  void set_neighbours(int direction) {
    defined_ = mpfr_number_p(below_) != 0;
    mpfr_set(above_, below_, MPFR_RNDN);
    if (direction < 0) mpfr_nextabove(above_);
    if (direction > 0) mpfr_nextbelow(below_);
  }

  bool defined_ = false;
  mpfr_t x_;
  mpfr_t y_;
  mpfr_t below_;
  mpfr_t above_;
};

}  // namespace coordreq
