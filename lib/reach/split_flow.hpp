#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reach/box_division.hpp"
#include "reach/periodic_flow.hpp"
#include "reach/solution_spread.hpp"

namespace coordreq {

/// PeriodicFlow of a box that is divided where its enclosure meets more cells than the solutions that were
/// followed (BoxDivision): the subboxes are enclosed each by itself, and the result is the hull of them all.
///
/// Where no two solutions can meet (PeriodicFlow::keeps_apart()) only the faces of the box are divided: the
/// flow for each signal of the disturbances is then a homeomorphism, which maps the boundary of the box to
/// the boundary of what is reached (invariance of domain), and each coordinate is extreme there. A solution
/// from inside cannot get out of the hull of what the faces lead to, so that it does not escape either.
///
/// Where the whole meets far more cells, the first subboxes are those whose solutions stay close to one
/// another on their way (SolutionSpread), so that few subboxes are enclosed in vain.
///
/// Parts of a line whose end is a summand take long steps first (ValidatedFlow). Where an end is not close to
/// what is reached then, the box is divided in short steps, too: few ends are farther out than in short steps
/// alone, and those by a part of a step of the grid.
///
/// Over-approximates always. Not thread-safe: use a copy a thread.
class SplitFlow {
 public:
  /// @param targets what the result has to be tight for; `state` is an index into the system's
  /// @param effort so many subboxes of a box are enclosed at most; 0: none is divided
  SplitFlow(PeriodicFlow flow, const FlowSystem& system, std::vector<EndCells> targets, std::int64_t effort);

  /// @pre unchecked: as PeriodicFlow::flow(). @returns a reference that is valid until the next call
  [[nodiscard]] const FlowEnclosure& flow(std::span<const Interval> slots);
  /// Boxes and subboxes that were enclosed so far.
  [[nodiscard]] std::int64_t enclosed() const { return wholes_ + division_.enclosed(); }
  /// See ValidatedFlow.
  [[nodiscard]] std::int64_t steps() const { return flow_.steps(); }

 private:
  [[nodiscard]] const FlowEnclosure& flow_of_subbox(std::span<const Interval> box);
  [[nodiscard]] bool can_use_faces();
  bool refine(std::vector<std::vector<Interval>> subboxes);
  bool divide_faces();
  bool divide_all();
  [[nodiscard]] std::vector<std::vector<Interval>> close_subboxes(std::vector<std::vector<Interval>> boxes);
  [[nodiscard]] bool faces_are_enough();
  void use_hull(bool by_faces);

  PeriodicFlow flow_;
  std::vector<std::uint32_t> state_slots_;
  BoxDivision division_;
  std::optional<SolutionSpread> spread_;  ///< none if nothing tells which difference is small
  std::int64_t wholes_ = 0;
  bool takes_long_steps_ = true;  ///< where subboxes are lines
  bool is_far_ = false;           ///< the whole meets far more cells than it need
  std::vector<Interval> slots_;
  std::vector<Interval> box_;  ///< the whole one, of the states
  FlowEnclosure result_;
};

}  // namespace coordreq
