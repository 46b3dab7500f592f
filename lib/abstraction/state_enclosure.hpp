#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dynamics/affine_dynamics.hpp"
#include "dynamics/map_enclosure.hpp"
#include "dynamics/validated_flow.hpp"
#include "numeric/interval.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// Encloses the next value of one state over boxes of what it depends on, in discrete or continuous time.
///
/// Over-approximates. Not thread-safe: use a copy a thread.
class StateEnclosure {
 public:
  enum class Status : std::uint8_t { ok, blows_up, undefined };
  struct Result {
    Status status = Status::ok;
    std::size_t culprit = 0;  ///< state whose equation is at fault, unless ok
    bool left_unsafely =
        false;       ///< unless ok: by then this state may have left through an unsafe side of its own
    Interval value;  ///< of the next state; of the difference to the present one if shifts()
    Interval tube;   ///< in continuous time: the same at all times in [0, tau]
    Interval drift;  ///< in continuous time: the difference to the present one, see FlowEnclosure::drift
  };

  /// REQUIRES: `spec` outlives this object.
  StateEnclosure(const ProblemSpec& spec, const Dependencies& dependencies, std::size_t state);

  /// x_i(tau) - x_i(0) does not depend on x_i: enclose() then gives the difference and needs no box of x_i.
  [[nodiscard]] bool shifts() const { return shifts_; }

  /// Sets the box of a state, input or parameter; disturbances are set already.
  void set(std::uint32_t slot, const Interval& box) { slots_[slot] = box; }

  [[nodiscard]] Result enclose();

 private:
  void prepare_map();
  void prepare_flow();
  [[nodiscard]] Result enclose_map();
  [[nodiscard]] Result enclose_flow();
  [[nodiscard]] Interval within_limits(Interval value) const;

  const ProblemSpec* spec_;
  Dependencies dependencies_;
  std::size_t state_;
  std::size_t position_ = 0;  ///< of the state among the moving ones
  bool shifts_ = false;
  double origin_ = 0;  ///< the present value put in where the map shifts
  std::vector<Interval> slots_;
  std::optional<MapEnclosure> map_;
  std::optional<ValidatedFlow> flow_;
};

}  // namespace coordreq
