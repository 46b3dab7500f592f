#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "expression/evaluate.hpp"
#include "reach/affine_dynamics.hpp"

namespace coordreq {

class PointFlow;

/// The sampled system followed from a point, for simulation. Disturbances are constant within a period.
///
/// Where the sampled map of a state is affine with rational coefficients (AffineDynamics), its next value is
/// exact; elsewhere it is that of PointFlow or, in discrete time, of the equation in double arithmetic,
/// brought to the nearest lattice point if the state is discrete. Scratch inside: one object a thread.
class PointDynamics {
 public:
  /// Beyond this many bits an exact state is refused: a run of that length should be cut in two.
  static constexpr std::size_t kMostBits = 100'000;

  /// @pre unchecked: `spec` outlives this object.
  explicit PointDynamics(const SystemSpec& spec);
  ~PointDynamics();
  PointDynamics(PointDynamics&&) noexcept;
  PointDynamics& operator=(PointDynamics&&) noexcept;

  /// Inputs, states and disturbances that next() of a state looks at.
  [[nodiscard]] const Dependencies& dependencies(std::size_t state) const {
    return affine_.dependencies(state);
  }

  /// Value of state `i` at the end of a period, before the rules of the sample (reset_at_sample()).
  /// @param slots values of what it depends on, at their slots
  /// @returns nothing if it is undefined or not finite. @throws LimitError beyond kMostBits
  [[nodiscard]] std::optional<Rational> next(std::size_t i, const std::vector<Rational>& slots);
  /// The share of the period up to which state `i` could be followed when next() last found nothing; in
  /// discrete time 0.
  [[nodiscard]] double followed(std::size_t i) const;

  struct Estimate {
    double value = 0;
    double error = 0;  ///< at most that far from what next() finds
  };
  /// next() in doubles where the sampled map is affine; nothing elsewhere. @param doubles nearest to `slots`
  [[nodiscard]] std::optional<Estimate> estimate(std::size_t i, const std::vector<Rational>& slots,
                                                 const std::vector<double>& doubles);

 private:
  /// Rows that are kept, of each state: what agents choose among comes again at every step.
  static constexpr std::size_t kMostRows = 512;

  struct Row {
    std::optional<SampledPoint> exact;  ///< nothing where the state has none
    bool has_doubles = false;           ///< the following are nearest to `exact`, with full precision
    double constant = 0;
    std::vector<std::pair<std::uint32_t, double>> summands = {};  ///< slot, what it is multiplied by
  };

  [[nodiscard]] const Row& row(std::size_t i, const std::vector<Rational>& slots);
  [[nodiscard]] Row find_row(std::size_t i, const std::vector<Rational>& slots) const;
  [[nodiscard]] std::optional<Rational> exact_next(std::size_t i, const std::vector<Rational>& slots);
  [[nodiscard]] std::optional<Rational> approximate_next(std::size_t i, const std::vector<Rational>& slots);
  [[nodiscard]] std::optional<double> double_next(std::size_t i);

  const SystemSpec* spec_;
  AffineDynamics affine_;
  std::vector<std::map<std::vector<Rational>, Row>> rows_;  ///< [state][values of its parameters and inputs]
  std::vector<Rational> key_;
  std::vector<std::unique_ptr<PointFlow>> flows_;  ///< by state, made when needed
  std::vector<std::size_t> positions_;             ///< of a state among the moving ones of its flow
  std::vector<double> doubles_;
};

}  // namespace coordreq
