#pragma once

#include <arb.h>
#include <arb_mat.h>
#include <arb_poly.h>
#include <flint/fmpq.h>
#include <utility>

#include "numeric/rational.hpp"

namespace coordreq {

/// A rational number as FLINT's functions take it.
class FlintRational {
 public:
  FlintRational() { fmpq_init(q_); }
  explicit FlintRational(const Rational& value) : FlintRational() { fmpq_set_mpq(q_, value.get_mpq_t()); }
  FlintRational(const FlintRational&) = delete;
  FlintRational& operator=(const FlintRational&) = delete;
  ~FlintRational() { fmpq_clear(q_); }

  [[nodiscard]] fmpq* get() { return q_; }
  [[nodiscard]] Rational value() const {
    Rational result;
    fmpq_get_mpq(result.get_mpq_t(), q_);
    return result;
  }

 private:
  fmpq_t q_;
};

/// Bits of a midpoint; more would only cost time: cells are never that small.
inline constexpr slong kArbBits = 64;

/// A real number enclosed in a ball of FLINT/Arb. Every operation encloses all results for all numbers in the
/// balls. What is not defined or not bounded is not finite. Points of few bits stay points.
class Arb {
 public:
  Arb() { arb_init(ball_); }
  explicit Arb(double value) : Arb() { arb_set_d(ball_, value); }
  explicit Arb(const Rational& value);
  Arb(const Arb& other) : Arb() { arb_set(ball_, other.ball_); }
  Arb(Arb&& other) noexcept : Arb() { arb_swap(ball_, other.ball_); }
  Arb& operator=(const Arb& other) {
    arb_set(ball_, other.ball_);
    return *this;
  }
  Arb& operator=(Arb&& other) noexcept {
    arb_swap(ball_, other.ball_);
    return *this;
  }
  ~Arb() { arb_clear(ball_); }

  [[nodiscard]] arb_ptr get() { return ball_; }
  [[nodiscard]] arb_srcptr get() const { return ball_; }

  [[nodiscard]] bool is_finite() const { return arb_is_finite(ball_) != 0; }
  [[nodiscard]] bool is_zero() const { return arb_is_zero(ball_) != 0; }
  [[nodiscard]] bool is_point() const { return arb_is_exact(ball_) != 0; }
  [[nodiscard]] bool is_nonnegative() const { return arb_is_nonnegative(ball_) != 0; }
  [[nodiscard]] bool is_nonpositive() const { return arb_is_nonpositive(ball_) != 0; }
  [[nodiscard]] bool holds(const Arb& other) const { return arb_contains(ball_, other.ball_) != 0; }

  /// The ends as points, rounded outward.
  [[nodiscard]] Arb lower() const;
  [[nodiscard]] Arb upper() const;
  [[nodiscard]] Arb middle() const;
  /// The ends, exactly. @pre is_finite()
  [[nodiscard]] Rational lower_rational() const;
  [[nodiscard]] Rational upper_rational() const;
  /// Roughly; for choices that need no proof.
  [[nodiscard]] double approximately() const { return arf_get_d(arb_midref(ball_), ARF_RND_NEAR); }
  [[nodiscard]] double width() const { return 2 * mag_get_d(arb_radref(ball_)); }

 private:
  arb_t ball_;
};

[[nodiscard]] inline Arb operator+(const Arb& a, const Arb& b) {
  Arb sum;
  arb_add(sum.get(), a.get(), b.get(), kArbBits);
  return sum;
}
[[nodiscard]] inline Arb operator-(const Arb& a, const Arb& b) {
  Arb difference;
  arb_sub(difference.get(), a.get(), b.get(), kArbBits);
  return difference;
}
[[nodiscard]] inline Arb operator*(const Arb& a, const Arb& b) {
  Arb product;
  arb_mul(product.get(), a.get(), b.get(), kArbBits);
  return product;
}
[[nodiscard]] inline Arb operator/(const Arb& a, const Arb& b) {
  Arb quotient;
  arb_div(quotient.get(), a.get(), b.get(), kArbBits);
  return quotient;
}
/// A ball that ends at 0, for a range that is known not to go beyond: rounding a radius widens others a
/// little.
[[nodiscard]] Arb ending_at_zero(const Arb& a, bool nonnegative);
/// A ball that holds both, and ends at 0 if both do not go beyond.
[[nodiscard]] Arb hull(const Arb& a, const Arb& b);
/// The points at or below (above) both: for ends. @pre both finite
[[nodiscard]] Arb lesser(const Arb& a, const Arb& b);
[[nodiscard]] Arb greater(const Arb& a, const Arb& b);
/// Whether a's middle is below b's; for ends, which are all but points.
[[nodiscard]] bool is_below(const Arb& a, const Arb& b);

/// |a| and a^2, without what rounding a ball adds below 0.
[[nodiscard]] Arb absolute(const Arb& a);
[[nodiscard]] Arb squared(const Arb& a);

/// A power series with such coefficients, cut off; see arb_poly of FLINT/Arb.
class ArbSeries {
 public:
  ArbSeries() { arb_poly_init(series_); }
  ArbSeries(const ArbSeries& other) : ArbSeries() { arb_poly_set(series_, other.series_); }
  ArbSeries(ArbSeries&& other) noexcept : ArbSeries() { arb_poly_swap(series_, other.series_); }
  ArbSeries& operator=(const ArbSeries& other) {
    arb_poly_set(series_, other.series_);
    return *this;
  }
  ArbSeries& operator=(ArbSeries&& other) noexcept {
    arb_poly_swap(series_, other.series_);
    return *this;
  }
  ~ArbSeries() { arb_poly_clear(series_); }

  [[nodiscard]] arb_poly_struct* get() { return series_; }
  [[nodiscard]] const arb_poly_struct* get() const { return series_; }

  [[nodiscard]] Arb operator[](slong k) const {
    Arb coefficient;
    arb_poly_get_coeff_arb(coefficient.get(), series_, k);
    return coefficient;
  }
  void set(slong k, const Arb& coefficient) { arb_poly_set_coeff_arb(series_, k, coefficient.get()); }
  /// Makes it a constant.
  void assign(const Arb& constant) { arb_poly_set_arb(series_, constant.get()); }

 private:
  arb_poly_t series_;
};

/// A matrix of such numbers.
class ArbMatrix {
 public:
  ArbMatrix(std::size_t rows, std::size_t columns) {
    arb_mat_init(matrix_, static_cast<slong>(rows), static_cast<slong>(columns));
  }
  ArbMatrix(const ArbMatrix& other) {
    arb_mat_init(matrix_, arb_mat_nrows(other.matrix_), arb_mat_ncols(other.matrix_));
    arb_mat_set(matrix_, other.matrix_);
  }
  ArbMatrix& operator=(ArbMatrix other) noexcept {
    arb_mat_swap(matrix_, other.matrix_);
    return *this;
  }
  ~ArbMatrix() { arb_mat_clear(matrix_); }

  [[nodiscard]] arb_mat_struct* get() { return matrix_; }
  [[nodiscard]] const arb_mat_struct* get() const { return matrix_; }
  [[nodiscard]] arb_ptr entry(std::size_t i, std::size_t j) { return arb_mat_entry(matrix_, i, j); }
  [[nodiscard]] Arb operator()(std::size_t i, std::size_t j) const {
    Arb value;
    arb_set(value.get(), arb_mat_entry(matrix_, i, j));
    return value;
  }
  void set(std::size_t i, std::size_t j, const Arb& value) { arb_set(entry(i, j), value.get()); }

 private:
  arb_mat_t matrix_;
};

[[nodiscard]] inline ArbMatrix operator*(const ArbMatrix& a, const ArbMatrix& b) {
  ArbMatrix product(static_cast<std::size_t>(arb_mat_nrows(a.get())),
                    static_cast<std::size_t>(arb_mat_ncols(b.get())));
  arb_mat_mul(product.get(), a.get(), b.get(), kArbBits);
  return product;
}

}  // namespace coordreq
