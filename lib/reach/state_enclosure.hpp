#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "numeric/interval.hpp"
#include "reach/affine_dynamics.hpp"
#include "reach/split_flow.hpp"
#include "reach/split_map.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Encloses the next value of one state over boxes of what it depends on, in discrete or continuous time.
///
/// Over-approximates. Not thread-safe: use a copy a thread.
class StateEnclosure {
 public:
  using Status = FlowEnclosure::Status;
  struct Result {
    Status status = Status::ok;
    std::size_t culprit = 0;  ///< state whose equation is at fault, unless ok
    double rate = 0.0;        ///< if too stiff, see FlowEnclosure::rate
    /// Unless ok: by then this state may have left through an unsafe side; or another one may, and this one
    /// has an unsafe side too.
    bool left_unsafely = false;
    Interval value;  ///< of the next state; of the difference to the present one if shifts()
    Interval tube;   ///< in continuous time: the same at all times in [0, tau]
    Interval drift;  ///< in continuous time: the difference to the present one, see FlowEnclosure::drift
  };

  /// @param states whose enclosures are asked for: one that shifts() is alone, in discrete time any is
  /// @param terms whether something is added to the results before cells are counted
  /// @pre unchecked: `spec` outlives this object.
  StateEnclosure(const SystemSpec& spec, const Dependencies& dependencies,
                 const std::vector<std::size_t>& states, bool terms = false);

  /// x_i(tau) - x_i(0) does not depend on x_i: result() then gives the difference and needs no box of x_i.
  [[nodiscard]] bool shifts() const { return shifts_; }

  /// Sets the box of a state, input or parameter; disturbances are set already.
  void set(std::uint32_t slot, const Interval& box) { slots_[slot] = box; }

  /// Finds out what result() tells.
  void enclose();
  /// @param state one of those of the constructor
  [[nodiscard]] Result result(std::size_t state) const;

  /// Boxes and subboxes that were enclosed so far.
  [[nodiscard]] std::int64_t enclosed() const { return map_ ? map_->enclosed() : flow_->enclosed(); }
  /// The work of that: sub-steps of flows, subboxes of maps.
  [[nodiscard]] std::int64_t work() const { return map_ ? map_->enclosed() : flow_->steps(); }

  /// The reason why the equation at fault is undefined in the last enclose(); empty if not known. @pre it is
  [[nodiscard]] std::string reason(const Result& result) const;

 private:
  void prepare_map();
  void prepare_flow(const std::vector<std::size_t>& states);
  [[nodiscard]] std::vector<std::size_t> served(const std::vector<std::size_t>& states) const;
  [[nodiscard]] EndCells cells_of(std::size_t state) const;
  [[nodiscard]] Result result_of_map() const;
  [[nodiscard]] Result result_of_flow(std::size_t state) const;

  const SystemSpec* spec_;
  Dependencies dependencies_;
  std::size_t state_;
  bool shifts_ = false;
  bool terms_ = false;
  double origin_ = 0;  ///< the present value put in where the map shifts
  std::vector<Interval> slots_;
  std::optional<SplitMap> map_;
  std::optional<SplitFlow> flow_;
  Interval map_value_;                    ///< by the last enclose()
  const FlowEnclosure* found_ = nullptr;  ///< likewise, within flow_
};

}  // namespace coordreq
