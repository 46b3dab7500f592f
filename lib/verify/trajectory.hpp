#pragma once

#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "verify/vector_field.hpp"

namespace coordreq {

/// Solutions of x' = f(x, w) from a point with constant w, enclosed step by step: by Taylor's formula with
/// Lagrange's remainder where f is analytic, by one of second order with Clarke's slopes where it has kinks,
/// by the range of f where it jumps. Steps are halved until the remainder is small enough.
class Trajectory {
 public:
  /// @pre unchecked: `field` outlives this object.
  explicit Trajectory(SeriesField& field) : field_(&field) {}

  /// @param duration a point; @param tolerance of the end, in the units of each state; a few halvings later
  /// a step is taken all the same
  /// @returns false if the solution may not last so long, or the work of the field is spent; then the box is
  /// not changed
  [[nodiscard]] bool advance(ArbBox& box, const Arb& duration, double tolerance);
  /// advance() without remembering the result, for durations that are needed once.
  /// @param most parts of the duration that are tried at most
  [[nodiscard]] bool integrate(ArbBox& box, const Arb& duration, double tolerance,
                               int most = std::numeric_limits<int>::max());
  /// One step by a Taylor polynomial with so many terms.
  /// @param tube holds the solution during the step
  /// @returns nothing where the remainder is larger than the tolerance
  [[nodiscard]] std::optional<ArbBox> analytic_step(const ArbBox& box, const ArbBox& tube,
                                                    const Arb& duration, double tolerance, slong terms);

 private:
  struct Order {
    [[nodiscard]] bool operator()(const ArbBox& a, const ArbBox& b) const;
  };

  [[nodiscard]] std::optional<ArbBox> step(const ArbBox& box, const Arb& duration, double tolerance,
                                           bool last_try);
  [[nodiscard]] ArbBox kinked_step(const ArbBox& box, const ArbBox& tube, const std::vector<Arb>& change,
                                   const Arb& duration);

  static constexpr std::uint32_t kFinest = 1U << 12U;  // parts of a duration

  struct Known {
    std::optional<ArbBox> end;
    Work work = 0;
  };

  SeriesField* field_;
  bool may_double_ = true;                ///< a step of twice its length looks promising
  std::map<ArbBox, Known, Order> known_;  ///< by box and duration
};

/// The limits of a state under `stop`: points at which it is held while its derivative points out.
struct StopLimits {
  std::optional<Arb> below;
  std::optional<Arb> above;
};

/// A box that no solution from `start` leaves within [0, duration] (Picard), and the range of derivatives
/// over it: of f, and 0 where a state may be held.
struct Tube {
  ArbBox box;
  std::vector<Arb> change;
};
/// @param limits one a state; none: there are no such
[[nodiscard]] std::optional<Tube> picard_tube(SeriesField& field, const ArbBox& start, const Arb& duration,
                                              const std::vector<StopLimits>& limits = {});

}  // namespace coordreq
