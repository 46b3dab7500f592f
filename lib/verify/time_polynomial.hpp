#pragma once

#include <flint/fmpq_poly.h>

#include <cstdint>
#include <initializer_list>

#include "numeric/rational.hpp"

namespace coordreq {

/// A polynomial in time with rational coefficients; see fmpq_poly of FLINT.
class TimePolynomial {
 public:
  TimePolynomial() { fmpq_poly_init(p_); }
  /// Coefficients of t^0, t^1, ...
  TimePolynomial(std::initializer_list<Rational> coefficients);
  TimePolynomial(const TimePolynomial& other) : TimePolynomial() { fmpq_poly_set(p_, other.p_); }
  TimePolynomial(TimePolynomial&& other) noexcept : TimePolynomial() { fmpq_poly_swap(p_, other.p_); }
  TimePolynomial& operator=(TimePolynomial other) noexcept {
    fmpq_poly_swap(p_, other.p_);
    return *this;
  }
  ~TimePolynomial() { fmpq_poly_clear(p_); }

  [[nodiscard]] const fmpq_poly_struct* get() const { return p_; }
  [[nodiscard]] bool is_zero() const { return fmpq_poly_is_zero(p_) != 0; }
  [[nodiscard]] bool is_one() const { return fmpq_poly_is_one(p_) != 0; }
  [[nodiscard]] Rational operator[](slong k) const;
  void set(slong k, const Rational& coefficient);
  [[nodiscard]] Rational at(const Rational& t) const;
  [[nodiscard]] TimePolynomial derivative() const;
  /// From 0 to t.
  [[nodiscard]] TimePolynomial integral() const;
  TimePolynomial& operator+=(const TimePolynomial& other) {
    fmpq_poly_add(p_, p_, other.p_);
    return *this;
  }
  TimePolynomial& operator*=(const Rational& factor);
  [[nodiscard]] bool operator==(const TimePolynomial& other) const {
    return fmpq_poly_equal(p_, other.p_) != 0;
  }

 private:
  fmpq_poly_t p_;
};
[[nodiscard]] inline TimePolynomial operator*(TimePolynomial p, const Rational& factor) {
  p *= factor;
  return p;
}

/// Whether p keeps its sign on [0, end]: 1 or -1; 0 if not, or if that is open for a root at an end; 1 if p
/// is 0 all over.
[[nodiscard]] int sign_on(const TimePolynomial& p, const Rational& end);

/// Bounds of floor(min over [0, end] of p): outer <= it <= inner. Equal but where the least value is an
/// integer, or all but, at an irrational time.
struct FloorOfLeast {
  std::int64_t outer = 0;
  std::int64_t inner = 0;
};
[[nodiscard]] FloorOfLeast floor_of_least(const TimePolynomial& p, const Rational& end);

/// The integral of |p| over [0, end]: what a disturbance of size 1 that switches adds up to.
struct SwitchingIntegral {
  Rational value;     ///< or a little more
  bool exact = true;  ///< it is the integral itself, and known to be by halving [0, end] as well
};
[[nodiscard]] SwitchingIntegral integrate_switching(const TimePolynomial& p, const Rational& end);

}  // namespace coordreq
