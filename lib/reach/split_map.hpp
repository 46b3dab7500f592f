#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reach/box_division.hpp"
#include "reach/map_enclosure.hpp"

namespace coordreq {

/// MapEnclosure of a box that is divided where its range meets more cells than values at single points
/// (BoxDivision): branch and bound for both ends of the range (Moore 1966; Skelboe 1974). Disturbances count
/// as variables, as each has one value in a step.
///
/// Over-approximates. Not thread-safe: use a copy a thread.
class SplitMap {
 public:
  /// @param box_slots as in MapEnclosure
  /// @param steps > 0, which lengths of variables are alike, one a slot
  /// @param target what the result has to be tight for
  /// @param effort so many subboxes of a box are enclosed at most; 0: none is divided
  SplitMap(const Program& equation, std::span<const std::uint32_t> box_slots,
           const std::vector<double>& steps, const EndCells& target, std::int64_t effort);

  /// As MapEnclosure::enclose().
  [[nodiscard]] Interval enclose(std::span<const Interval> slots);
  /// Boxes and subboxes that were enclosed so far.
  [[nodiscard]] std::int64_t enclosed() const { return wholes_ + division_.enclosed(); }

 private:
  const FlowEnclosure& enclose_subbox(std::span<const Interval> box);
  void enclose_slots();

  MapEnclosure map_;
  BoxDivision division_;
  std::int64_t wholes_ = 0;
  std::vector<Interval> slots_;
  FlowEnclosure found_;
};

}  // namespace coordreq
