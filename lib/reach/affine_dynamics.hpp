#pragma once

#include <optional>
#include <vector>

#include "model/table_shape.hpp"
#include "numeric/rational.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The sampled map of one state for fixed parameters and inputs:
/// x_i(tau) in sum_j coefficient[j] * x_{moving[j]}(0) + [lower, upper].
struct SampledRow {
  std::vector<Rational> coefficient;
  Rational lower;  ///< constant part plus all that disturbances can add
  Rational upper;
  bool exact = true;  ///< [lower, upper] is the exact hull, both ends attained; else it is rounded outward
};

/// The same under disturbances that are constant in a period:
/// x_i(tau) = sum_j coefficient[j] * x_{moving[j]}(0) + sum_l disturbance[l] * w_l + constant.
struct SampledPoint {
  std::vector<Rational> coefficient;
  std::vector<Rational> disturbance;
  Rational constant;
};

/// Whether `stop` limits are part of the dynamics, or cannot be reached.
enum class Limits : std::uint8_t { obeyed, ignored };

/// Systems whose sampled map is affine in the continuous states with rational coefficients for every fixed
/// input and value of the discrete states (contract, "Cells"): discrete-time maps of that form, and
/// differential equations of that form whose matrix is nilpotent, solved in rational arithmetic.
///
/// Immutable, so safe to share between threads.
class AffineDynamics {
 public:
  /// @pre unchecked: `spec` outlives this object.
  explicit AffineDynamics(const SystemSpec& spec);

  [[nodiscard]] const Dependencies& dependencies(std::size_t state) const { return dependencies_[state]; }

  /// Whether a state that it depends on may be stopped.
  [[nodiscard]] bool has_limit(std::size_t state) const;

  /// @param slots exact values of all parameters and inputs of `state` at their slots; others are ignored
  /// @returns nothing if the system is not of the class above for these values, or if a state of it has a
  ///   `stop` limit that is obeyed or, in continuous time, is periodic and used in an equation
  /// @throws SpecError if the equation is not defined there; the message names the state and the values
  [[nodiscard]] std::optional<SampledRow> row(std::size_t state, const std::vector<Rational>& slots,
                                              Limits limits = Limits::obeyed) const;

  /// @param slots as in row() @returns nothing where row() returns nothing, or if its constant part is no
  /// single
  ///   value @throws SpecError as row() does
  [[nodiscard]] std::optional<SampledPoint> point_row(std::size_t state,
                                                      const std::vector<Rational>& slots) const;

  /// Where the state is at any time in [0, tau] under continuous time: x_i(t) is in the convex hull of the
  /// rows' values, for every initial state. The first row is x_i(0), and for integrators (x' = c + w) the
  /// hull is exact.
  /// @param slots as in row() @returns nothing where row() returns nothing
  [[nodiscard]] std::optional<std::vector<SampledRow>> tube_rows(std::size_t state,
                                                                 const std::vector<Rational>& slots,
                                                                 Limits limits = Limits::obeyed) const;

 private:
  /// A discrete state that stays what it is; nothing for one that moves.
  [[nodiscard]] std::optional<SampledRow> constant_row(std::size_t state,
                                                       const std::vector<Rational>& slots) const;
  [[nodiscard]] std::optional<SampledRow> map_row(std::size_t state,
                                                  const std::vector<Rational>& slots) const;
  [[nodiscard]] std::optional<SampledRow> flow_row(std::size_t state,
                                                   const std::vector<Rational>& slots) const;
  [[nodiscard]] std::optional<SampledPoint> map_point(std::size_t state,
                                                      const std::vector<Rational>& slots) const;
  [[nodiscard]] std::optional<SampledPoint> flow_point(std::size_t state,
                                                       const std::vector<Rational>& slots) const;

  const SystemSpec* spec_;
  std::vector<Dependencies> dependencies_;
};

}  // namespace coordreq
