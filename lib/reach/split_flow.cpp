#include "reach/split_flow.hpp"

#include <algorithm>
#include <utility>

namespace coordreq {
namespace {

/// An enclosure that meets more cells than this beyond those of solutions that were followed is divided.
constexpr double kLooseFlow = 1.5;

}  // namespace

SplitFlow::SplitFlow(PeriodicFlow flow, const FlowSystem& system, std::vector<EndCells> targets,
                     std::int64_t effort)
    : flow_(std::move(flow)),
      state_slots_(system.state_slots),
      division_(std::move(targets), system.steps, effort) {}

const FlowEnclosure& SplitFlow::flow(std::span<const Interval> slots) {
  const FlowEnclosure& whole = flow_.flow(slots);
  if (division_.effort() <= 0 || !division_.is_loose(whole, kLooseFlow)) return whole;
  result_ = whole;
  slots_.assign(slots.begin(), slots.end());
  box_.clear();
  for (const std::uint32_t slot : state_slots_) box_.push_back(slots[slot]);
  const bool by_faces = can_use_faces();
  if (by_faces ? divide_faces() : divide_all()) take_over(by_faces);
  return result_;
}

const FlowEnclosure& SplitFlow::flow_of_part(std::span<const Interval> box) {
  for (std::size_t i = 0; i < box.size(); ++i) slots_[state_slots_[i]] = box[i];
  return flow_.flow_of_part(slots_);
}

bool SplitFlow::can_use_faces() {
  const bool is_full = std::none_of(box_.begin(), box_.end(), [](const Interval& a) { return a.is_point(); });
  return is_full && static_cast<std::int64_t>(2 * box_.size()) <= division_.effort() &&
         flow_.keeps_apart(box_);
}

/// @returns whether that gave an enclosure of the whole
bool SplitFlow::divide_faces() {
  division_.begin(result_.reached);
  for (std::size_t i = 0; i < box_.size(); ++i) {
    for (const double end : {box_[i].lower, box_[i].upper}) {
      std::vector<Interval> face = box_;
      face[i] = Interval(end);
      division_.add(face, flow_of_part(face));
    }
  }
  return division_.refine([this](std::span<const Interval> box) -> const FlowEnclosure& {
    return flow_of_part(box);
  }) && faces_are_enough();
}

/// @returns whether all parts have enclosures
bool SplitFlow::divide_all() {
  division_.begin(result_.reached);
  division_.add(box_, result_);
  return division_.refine(
      [this](std::span<const Interval> box) -> const FlowEnclosure& { return flow_of_part(box); });
}

/// Whether nothing from inside the box can pass what its faces lead to.
bool SplitFlow::faces_are_enough() {
  std::vector<Interval> tube = division_.parts().front().found.tube;
  for (const BoxDivision::Part& part : division_.parts()) {
    for (std::size_t i = 0; i < tube.size(); ++i) tube[i] = hull(tube[i], part.found.tube[i]);
  }
  return flow_.keeps_apart(tube);
}

/// Puts the hull of all parts into the result.
void SplitFlow::take_over(bool by_faces) {
  FlowEnclosure all = division_.parts().front().found;
  for (const BoxDivision::Part& part : division_.parts()) {
    for (std::size_t i = 0; i < box_.size(); ++i) {
      all.end[i] = hull(all.end[i], part.found.end[i]);
      all.tube[i] = hull(all.tube[i], part.found.tube[i]);
      all.drift[i] = hull(all.drift[i], part.found.drift[i]);
    }
  }
  all.reached = division_.reached();
  for (std::size_t i = 0; i < box_.size(); ++i) {
    // How far a state has moved need not be extreme where it started from the boundary.
    if (by_faces) all.drift[i] = hull(all.tube[i], box_[i]) - box_[i];
    if (result_.status != FlowEnclosure::Status::ok) continue;
    const auto both = [](Interval& a, const Interval& b) { a = intersect(a, b).value_or(a); };
    both(all.end[i], result_.end[i]);
    both(all.tube[i], result_.tube[i]);
    both(all.drift[i], result_.drift[i]);
  }
  result_ = std::move(all);
}

}  // namespace coordreq
