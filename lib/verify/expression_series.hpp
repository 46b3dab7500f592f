#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "expression/program.hpp"
#include "numeric/truth.hpp"
#include "verify/arb.hpp"

namespace coordreq {

/// How an expression behaves over all of a box.
enum class Smoothness : std::uint8_t {
  analytic,   ///< one formula without kinks
  lipschitz,  ///< kinks, as of abs at 0; coefficient 1 encloses all its slopes (Clarke's)
  jumps,      ///< perhaps different formulas that do not meet; only coefficient 0 counts
};

/// Runs an expression over power series: constant terms alone give its range over a box, two terms its slope
/// in one direction, more its Taylor series in time. Encloses. What is not defined is not finite. Scratch
/// inside: one object a thread.
class ExpressionSeries {
 public:
  /// @pre `program` is a number. @pre unchecked: it outlives this object
  explicit ExpressionSeries(const Program& program);

  /// @param slots series of all variables; @param length of the series, at least 1
  const ArbSeries& operator()(std::span<const ArbSeries> slots, slong length);
  /// The series with one term more than in the last result: nodes made by + - * / and squares have only this
  /// term computed.
  /// @param length of the series, at least 2
  /// @pre unchecked: the last result is for slots whose series agree in all other terms
  const ArbSeries& extend(std::span<const ArbSeries> slots, slong length);
  /// Smoothness of the last result. Where it is not analytic, coefficients from 2 on mean nothing.
  [[nodiscard]] Smoothness smoothness() const { return smoothness_; }
  /// Number of operations, and of those that extend() carries out anew; a function like sin counts as
  /// several.
  [[nodiscard]] std::size_t operations() const { return operations_; }
  [[nodiscard]] std::size_t repeated_operations() const { return repeated_; }

 private:
  [[nodiscard]] bool is_extended(std::size_t n) const;
  void extend_number(std::size_t n, std::span<const ArbSeries> slots, slong k);
  void run_number(std::size_t n, std::span<const ArbSeries> slots, slong length);
  void keep_side(std::size_t n);
  void run_binary(std::size_t n, slong length);
  void run_unary(std::size_t n, slong length);
  void run_power(std::size_t n, slong length);
  void run_absolute(std::size_t n, slong length);
  void run_sign(std::size_t n);
  void run_floor(std::size_t n);
  void run_choice(std::size_t n, bool minimum, slong length);
  void run_if(std::size_t n, slong length);
  [[nodiscard]] bool is_same(std::size_t a, std::size_t b) const;
  [[nodiscard]] bool is_constant(std::size_t n) const;
  void lose(Smoothness smoothness);

  const Program* program_;
  std::vector<ArbSeries> values_;
  std::vector<Truth> truths_;
  std::size_t operations_ = 0;
  std::size_t repeated_ = 0;
  Smoothness smoothness_ = Smoothness::analytic;
};

/// The series of atan2(y, x), cut off at `length`. Not finite where the balls hold the origin.
/// @returns whether the angle may jump in the balls; the series is then a constant that holds all angles
[[nodiscard]] bool angle_series(ArbSeries& result, const ArbSeries& y, const ArbSeries& x, slong length);

}  // namespace coordreq
