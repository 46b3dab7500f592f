#pragma once

#include <optional>
#include <span>
#include <vector>

#include "reach/flow_system.hpp"
#include "reach/tape_values.hpp"

namespace coordreq {

/// Why no enclosure could be found, and for which equation.
struct FlowFailure {
  bool undefined = false;  ///< the right-hand side is not defined somewhere; else solutions may escape
  std::size_t equation = 0;
};

/// Right-hand sides over boxes, and enclosures of the solutions that start in a box.
///
/// Scratch memory for one thread. @pre unchecked: system and tape outlive it.
class VectorField {
 public:
  VectorField(const FlowSystem& system, const FlowTape& tape);

  /// Sets the slots that are constant in time; also the disturbances' boxes.
  void begin(std::span<const Interval> slots);
  void set_disturbance(std::size_t l, const Interval& value) {
    slots_[system_->disturbance_slots[l]] = value;
  }
  /// From now on the discontinuities that are pinned in `pins` have the values given there; nullptr: none.
  void pin(const Choices* pins) { pins_ = pins; }
  /// Puts the states into slots(), as evaluate() does.
  void set_state(std::span<const Interval> state);

  /// Encloses f over the box; nothing is returned where that went well.
  std::optional<FlowFailure> evaluate(std::span<const Interval> state, std::span<Interval> derivative);

  /// All states that solutions from `start` can take during [0, duration]: `box`, with f over it in
  /// `derivative`. Picard iteration with inflation: if start + [0, h] f(B) lies in the interior of B, no
  /// solution leaves B, not even where f is not Lipschitz. States with a limit are clipped to it. A side of
  /// `start` that f does not point out of, at the states close to it, is a wall that no solution passes.
  /// @returns nothing if found
  std::optional<FlowFailure> enclose_solutions(std::span<const Interval> start, const Interval& duration,
                                               std::span<Interval> box, std::span<Interval> derivative);

  /// The part of `a` that state i can take.
  [[nodiscard]] Interval clipped(std::size_t i, const Interval& a) const;

  /// Whether a limit of state i is in `a`.
  [[nodiscard]] bool meets_limit(std::size_t i, const Interval& a) const;

  /// Whether the equations jump in state i where it goes round.
  [[nodiscard]] bool has_seams(std::size_t i) const {
    return !system_->seams.empty() && !system_->seams[i].empty();
  }
  /// Whether a seam runs through the interior of the box.
  [[nodiscard]] bool is_on_seam(std::span<const Interval> box) const;

  [[nodiscard]] std::size_t dimension() const { return tape_->outputs.size(); }
  [[nodiscard]] const TapeValues<Interval>& values() const { return values_; }
  [[nodiscard]] std::span<const Interval> slots() const { return slots_; }
  [[nodiscard]] const FlowSystem& system() const { return *system_; }

 private:
  [[nodiscard]] bool is_inside(std::size_t i, const Interval& a, const Interval& box) const;
  struct Walls {
    bool lower = false;
    bool upper = false;
  };

  void guess(std::span<const Interval> start, const Interval& time, std::span<const Interval> derivative,
             std::span<Interval> box);
  bool find_walls(std::span<const Interval> start, std::span<const Interval> derivative,
                  std::span<Interval> box);
  bool is_wall(std::size_t i, bool upper, std::span<Interval> box);
  bool walls_hold(std::span<const Interval> start, std::span<Interval> box);
  std::optional<FlowFailure> iterate(std::span<const Interval> start, const Interval& time,
                                     std::span<Interval> box, std::span<Interval> derivative);
  [[nodiscard]] Interval image(std::size_t i, std::span<const Interval> start, const Interval& time,
                               const Interval& derivative) const;
  bool contract(std::span<const Interval> start, const Interval& time, std::span<const Interval> derivative,
                double inflation, std::span<Interval> box);

  const FlowSystem* system_;
  const FlowTape* tape_;
  const Choices* pins_ = nullptr;
  TapeValues<Interval> values_;
  std::vector<Interval> slots_;
  std::vector<Walls> walls_;
  std::vector<Interval> images_;
  bool steep_;             ///< solutions may not be unique
  std::size_t worst_ = 0;  ///< the equation that last grew out of its box
};

}  // namespace coordreq
