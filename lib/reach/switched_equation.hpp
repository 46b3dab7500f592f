#pragma once

#include <span>
#include <vector>

#include "expression/program.hpp"
#include "numeric/truth.hpp"

namespace coordreq {

/// An equation in double arithmetic whose switches can be kept where they are: abs, sign, floor, min, max,
/// atan2 and the comparisons in the conditions of `if`. While they are kept the equation is smooth, also a
/// little beyond the place where one of them would switch, so that an integrator can step over that place and
/// find it.
///
/// Each switch is on the side -1, 0 or 1: the sign of its argument, or of the difference of its arguments;
/// the side of floor is its value, that of atan2 is 0 away from its cut. NaN where undefined. Scratch inside:
/// one object a thread.
class SwitchedEquation {
 public:
  /// @pre `program` is a number. @pre unchecked: it outlives this object
  explicit SwitchedEquation(const Program& program);

  [[nodiscard]] bool has_switches() const { return has_switches_; }

  /// The value with all switches kept. Notes whether one of them should be on another side.
  [[nodiscard]] double kept(std::span<const double> slots) { return run(slots, true, false); }
  /// The value as it is. The switches stay where they are.
  [[nodiscard]] double actual(std::span<const double> slots) { return run(slots, false, false); }
  /// actual(), and puts every switch on its side.
  double settle(std::span<const double> slots) { return run(slots, false, true); }

  /// Whether a switch was not on its side in the last run.
  [[nodiscard]] bool left_its_sides() const { return left_; }

 private:
  double run(std::span<const double> slots, bool keep, bool move);
  [[nodiscard]] double side_now(const Program::Node& node) const;
  [[nodiscard]] double number_of(const Program::Node& node, std::span<const double> slots, double side) const;

  const Program* program_;
  bool has_switches_ = false;
  bool left_ = false;
  std::vector<double> constants_;
  std::vector<double> numbers_;
  std::vector<Truth> truths_;
  std::vector<double> sides_;  ///< of every node
};

}  // namespace coordreq
