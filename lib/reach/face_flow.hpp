#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reach/a_priori.hpp"
#include "reach/face_slope.hpp"
#include "reach/validated_flow.hpp"

namespace coordreq {

/// Encloses solutions by bounds of each state for itself: an end of them moves as fast as the right-hand side
/// allows on the face where the state is at that end and the others are within their bounds (Mueller 1927;
/// Ramdani, Meslem, Candau 2009, DOI 10.1109/TAC.2009.2028974). What a state multiplied by a disturbance does
/// elsewhere is of no account, and what decays fast has bounds that stay where it settles, so that steps may
/// be far longer than its time constant.
///
/// Loses what the states have to do with each other: a box that turns is enclosed in a larger one in every
/// step. Equations that jump, or are too steep, are bounded by their values over all of a step. Not for
/// systems with seams.
///
/// Over-approximates. Scratch memory for one thread.
class FaceFlow {
 public:
  /// @pre unchecked: the system outlives this object.
  explicit FaceFlow(const FlowSystem& system);

  /// @param slots as in ValidatedFlow::flow()
  /// @param field for limits of the states
  /// @returns nothing if `result` has the enclosure, else the equation at fault
  std::optional<FlowFailure> enclose(std::span<const Interval> slots, const VectorField& field,
                                     const Interval& period, FlowEnclosure& result);

  /// The fastest decay that was met, in units of one over time: what makes steps small.
  [[nodiscard]] double fastest_decay() const { return fastest_decay_; }
  /// Sub-steps that were tried so far.
  [[nodiscard]] std::int64_t tries() const { return tries_; }

 private:
  [[nodiscard]] static std::size_t side(std::size_t i, bool upper) { return 2 * i + (upper ? 1 : 0); }
  /// An end of the present box, seen outward: of a lower end, as of all that belongs to one, minus it.
  [[nodiscard]] double start(std::size_t i, bool upper) const {
    return upper ? now_[i].upper : -now_[i].lower;
  }

  void begin(std::span<const Interval> slots, const VectorField& field, const Interval& period);
  bool try_step(const Interval& duration, bool divisible);
  bool find_levels(double duration);
  void set_level(std::size_t i, bool upper, double level);
  bool holds(std::size_t i, bool upper, double level, double duration);
  double steepest(std::size_t i, bool upper, double from, double to);
  bool raise_level(std::size_t i, bool upper, double duration, int round);
  [[nodiscard]] double limit(std::size_t i, bool upper) const;
  [[nodiscard]] double innermost_level(std::size_t i, bool upper) const;
  bool find_rates(const Interval& duration);
  Interval first_rate(std::size_t i, bool upper);
  bool update_rate(std::size_t i, bool upper, const Interval& duration, int round);
  [[nodiscard]] static double end_of_step(double start, const Interval& duration,
                                          const FaceSlope::Bound& bound);
  Interval settle(std::size_t i, bool upper, const Interval& duration);
  void finish_step(const Interval& duration, FlowEnclosure& result);

  const VectorField* field_ = nullptr;
  std::size_t n_;
  std::vector<std::uint32_t> state_slots_;
  std::vector<FaceSlope> slopes_;
  std::vector<double> tolerance_;  ///< of each state, for a whole period
  double period_ = 0.0;
  std::vector<Interval> now_;
  std::vector<Interval> next_;
  std::vector<Interval> box_;  ///< of the step, with a margin
  std::vector<Interval> face_;
  MovingBounds moving_;
  // One for each end of each state, see side().
  std::vector<double> level_;  ///< that the state does not pass during the step, seen outward
  std::vector<bool> simple_;   ///< it is followed by values over all of the step
  std::vector<FaceSlope::Bound> bounds_;
  double fastest_decay_ = 0.0;
  std::int64_t tries_ = 0;
  bool settles_ = false;  ///< some end has been followed so
  bool undefined_ = false;
  std::size_t worst_ = 0;
};

}  // namespace coordreq
