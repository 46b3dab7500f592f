#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "reach/seam.hpp"
#include "reach/validated_flow.hpp"

namespace coordreq {

/// ValidatedFlow where states may be periodic: the equations see their representatives, the enclosures are
/// those of the states followed without wrapping.
///
/// Where no state leaves its ring that is the flow of the equations as they are. Else they are wound
/// (seam.hpp), the rounding error of a period being one more disturbance, and seams that an equation jumps
/// at are passed in small steps that keep boxes only. Where a state winds too often, its representative is a
/// disturbance.
///
/// Over-approximates always. Not thread-safe: use a copy a thread.
class PeriodicFlow {
 public:
  /// @param rings one a state. @pre unchecked: the equations outlive this object.
  PeriodicFlow(FlowSystem system, const std::vector<std::optional<Ring>>& rings, double tau_lower,
               double tau_upper);

  /// @pre unchecked: the boxes of periodic states that an equation mentions are within their rings; where
  /// such a box touches `upper`, that point itself is not meant.
  /// @param slots as in ValidatedFlow::flow() @returns a reference that is valid until the next call
  [[nodiscard]] const FlowEnclosure& flow(std::span<const Interval> slots);
  /// See ValidatedFlow.
  [[nodiscard]] const FlowEnclosure& flow_of_subbox(std::span<const Interval> slots, bool long_steps);

  /// Whether no two solutions can meet within `box`, see ValidatedFlow, and no periodic state that an
  /// equation mentions gets to its seam there. For the slots of the last flow().
  [[nodiscard]] bool keeps_apart(std::span<const Interval> box);

  /// See ValidatedFlow.
  [[nodiscard]] std::int64_t extra_steps() const;
  [[nodiscard]] std::int64_t steps() const;

  /// About.
  [[nodiscard]] double period() const { return period_; }

 private:
  enum class Kind : std::uint8_t { whole, subbox, subbox_in_long_steps };
  /// A periodic state that an equation mentions.
  struct Winding {
    std::size_t state = 0;  ///< index into the system's
    Ring ring;
    SeamSlots slots;
    bool as_number = false;
    Rational mismatch = 0;
    std::int64_t turns = 0;  ///< that the present enclosure allows for
  };
  /// The system with equations of its own.
  struct Wound {
    std::shared_ptr<const std::vector<Program>> equations;
    ValidatedFlow flow;
  };

  void find_windings(const FlowSystem& system, const std::vector<std::optional<Ring>>& rings);
  [[nodiscard]] Wound wind_system(const FlowSystem& system, Representative representative,
                                  const Interval& period);
  [[nodiscard]] const FlowEnclosure& flow(std::span<const Interval> slots, Kind kind);
  [[nodiscard]] bool stays(const FlowEnclosure& plain) const;
  void allow_for(std::int64_t turns, Winding& winding);
  [[nodiscard]] static std::int64_t turns_of(const Winding& winding, const FlowEnclosure& found);
  [[nodiscard]] std::optional<std::size_t> find_excess(const FlowEnclosure& found) const;

  double period_;
  ValidatedFlow plain_;
  std::vector<Winding> windings_;
  std::optional<Wound> followed_;
  std::optional<Wound> anywhere_;
  std::vector<Interval> slots_;
  FlowEnclosure failure_;
};

}  // namespace coordreq
