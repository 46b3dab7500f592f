#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "expression/dual.hpp"
#include "expression/evaluate.hpp"
#include "expression/program.hpp"

namespace coordreq {

/// The range of an expression over a box.
///
/// Variables with a derivative of proven sign are put at the end where the extreme is, again and again as the
/// box so shrunk proves more; over what is left natural interval evaluation is intersected with the mean
/// value form f(m) + sum_j f'_j (x_j - m_j). The exact hull up to rounding where interval derivatives show f
/// to be monotone in every variable, so also for sums of multiples in which variables are repeated.
///
/// Over-approximates. Not thread-safe, as it holds its scratch memory: use a copy a thread.
class MapEnclosure {
 public:
  /// @param box_slots the variables that may be more than points; all others count as constants
  /// @pre `equation` is a number. @pre unchecked: it outlives this object
  MapEnclosure(const Program& equation, std::span<const std::uint32_t> box_slots);

  /// `total` is false if the expression is not defined somewhere in the box; the ends may be infinite.
  /// @param slots a value for every variable of the equation at its slot
  [[nodiscard]] Interval enclose(std::span<const Interval> slots);

  /// Hull of enclosures of single values in the last range; nothing if none was computed.
  [[nodiscard]] const std::optional<Interval>& reached() const { return reached_; }
  /// Slots of the variables that may be boxes and that the equation mentions.
  [[nodiscard]] const std::vector<std::uint32_t>& directions() const { return directions_; }
  /// Index of the direction that keeps the last range from being known better, by what its derivative may be;
  /// as many as there are if that is not known.
  [[nodiscard]] std::size_t loosest() const;

 private:
  Interval bounds(std::span<const Interval> slots, bool upper, const Interval& natural);
  const Interval& evaluate_with_gradient();
  [[nodiscard]] bool move_to_extreme(bool upper);
  [[nodiscard]] Interval mean_value_form();
  void note_spread();

  Evaluator<Interval> natural_;
  Evaluator<Dual> derivative_;
  std::vector<std::uint32_t> directions_;  ///< slots that the equation mentions and that may be boxes
  std::vector<Interval> box_;
  std::vector<Interval> middle_;
  std::vector<Dual> dual_;
  std::vector<Interval> gradient_;
  std::vector<double> spread_;  ///< what each direction adds to the range, as far as it is not known
  std::optional<Interval> reached_;
  double jump_ = 0.0;
  Interval value_;
};

}  // namespace coordreq
