#pragma once

#include <span>
#include <vector>

#include "numeric/matrix.hpp"
#include "reach/a_priori.hpp"

namespace coordreq {

/// Differences of a right-hand side f over a box of states and disturbances: for all points (x, w), (y, v)
///
///     f(x, w) - g(y, v)  in  state (x - y) + disturbance (w - v) + jump,
///
/// where g is f with its open discontinuities pinned to the middle of their range (see Dual).
/// Matrices n x n and n x m. Scratch memory for one thread.
class Jacobian {
 public:
  /// @pre unchecked: system and tape outlive it.
  Jacobian(const FlowSystem& system, const FlowTape& tape);

  /// Sets what is constant in time, and the disturbances' boxes.
  void begin(std::span<const Interval> slots);
  void evaluate(std::span<const Interval> box);

  [[nodiscard]] const IntervalMatrix& state() const { return state_; }
  [[nodiscard]] const IntervalMatrix& disturbance() const { return disturbance_; }
  /// Half the width; the jump is symmetric about 0.
  [[nodiscard]] const RealVector& jump() const { return jump_; }

 private:
  void collect(std::size_t first, std::size_t count);

  const FlowSystem* system_;
  const FlowTape* tape_;
  std::vector<std::uint32_t> directions_;  ///< slots: states, then disturbances
  TapeValues<Dual> values_;
  std::vector<Dual> slots_;
  IntervalMatrix gradient_;  ///< by all directions
  IntervalMatrix state_;
  IntervalMatrix disturbance_;
  RealVector jump_;
};

}  // namespace coordreq
