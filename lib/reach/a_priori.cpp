#include "reach/a_priori.hpp"

#include <algorithm>
#include <cmath>

namespace coordreq {
namespace {

constexpr int kIterations = 12;
/// The widening of the first guess and of every box that proved too small, as a part of their growth; later
/// twice as much each time, since growth from a singularity is slow to show its size.
constexpr double kInflation = 0.125;
constexpr int kModestIterations = 4;
/// So that a box without growth is widened beyond what rounding adds.
constexpr double kRelativeMargin = 1e-14;
constexpr double kLeastMargin = 1e-290;

double margin(const Interval& a) {
  return std::max(std::fabs(a.lower), std::fabs(a.upper)) * kRelativeMargin + kLeastMargin;
}

/// Covers `grown` and goes on for a part of the way that it lies beyond `start`.
Interval inflated(const Interval& start, const Interval& grown, double inflation = kInflation) {
  const double more = margin(grown);
  return {grown.lower - inflation * std::max(start.lower - grown.lower, 0.0) - more,
          grown.upper + inflation * std::max(grown.upper - start.upper, 0.0) + more};
}

/// Whether the slope of a function may be unbounded where it is defined.
bool is_steep(const FlowTape& tape, const FlowTape::Node& node) {
  const FlowTape::Node& by = tape.nodes[node.b];
  switch (node.op) {
    case Operator::power:
      return by.op != Operator::constant || !is_integer(tape.constants[by.a]);
    case Operator::square_root:
    case Operator::arcsine:
    case Operator::arccosine:
      return true;
    default:
      return is_discontinuous(node.op);
  }
}

}  // namespace

VectorField::VectorField(const FlowSystem& system, const FlowTape& tape)
    : system_(&system),
      tape_(&tape),
      values_(tape),
      slots_(system.slot_count),
      walls_(tape.outputs.size()),
      images_(tape.outputs.size()),
      steep_(std::any_of(tape.nodes.begin(), tape.nodes.end(),
                         [&](const FlowTape::Node& node) { return is_steep(tape, node); })) {}

void VectorField::begin(std::span<const Interval> slots) {
  std::copy(slots.begin(), slots.end(), slots_.begin());
  pins_ = nullptr;
  values_.run_fixed(slots_);
}

void VectorField::set_state(std::span<const Interval> state) {
  for (std::size_t i = 0; i < state.size(); ++i) slots_[system_->state_slots[i]] = state[i];
}

std::optional<FlowFailure> VectorField::evaluate(std::span<const Interval> state,
                                                 std::span<Interval> derivative) {
  set_state(state);
  values_.run(tape_->values, slots_, pins_);
  for (std::size_t i = 0; i < derivative.size(); ++i) {
    derivative[i] = values_[tape_->outputs[i]];
    if (!derivative[i].total) return FlowFailure{true, i};
    if (!derivative[i].is_finite()) return FlowFailure{false, i};
  }
  return std::nullopt;
}

Interval VectorField::clipped(std::size_t i, const Interval& a) const {
  if (system_->stops.empty()) return a;
  const FlowSystem::Limit& limit = system_->stops[i];
  Interval result = a;
  if (limit.below) {
    result.lower = std::max(result.lower, limit.lower.lower);
    result.upper = std::max(result.upper, limit.lower.upper);
  }
  if (limit.above) {
    result.lower = std::min(result.lower, limit.upper.lower);
    result.upper = std::min(result.upper, limit.upper.upper);
  }
  return result;
}

bool VectorField::meets_limit(std::size_t i, const Interval& a) const {
  if (system_->stops.empty()) return false;
  const FlowSystem::Limit& limit = system_->stops[i];
  return (limit.below && a.lower <= limit.lower.upper) || (limit.above && a.upper >= limit.upper.lower);
}

bool VectorField::is_on_seam(std::span<const Interval> box) const {
  for (std::size_t i = 0; i < system_->seams.size(); ++i) {
    for (const Interval& seam : system_->seams[i]) {
      if (box[i].lower < seam.upper && box[i].upper > seam.lower) return true;
    }
  }
  return false;
}

/// In the interior, or at a limit or a wall that cannot be passed.
bool VectorField::is_inside(std::size_t i, const Interval& a, const Interval& box) const {
  const FlowSystem::Limit limit = system_->stops.empty() ? FlowSystem::Limit{} : system_->stops[i];
  const bool lower =
      box.lower < a.lower || walls_[i].lower || (limit.below && box.lower <= limit.lower.lower);
  const bool upper =
      a.upper < box.upper || walls_[i].upper || (limit.above && box.upper >= limit.upper.upper);
  return lower && upper;
}

/// start + time * derivative, as far as it can be reached.
Interval VectorField::image(std::size_t i, std::span<const Interval> start, const Interval& time,
                            const Interval& derivative) const {
  Interval moved;
  rounded_upward([&] {
    moved = (UpwardInterval(start[i]) + UpwardInterval(time) * UpwardInterval(derivative)).interval();
  });
  Interval result = clipped(i, moved);
  if (walls_[i].lower) result.lower = std::max(result.lower, start[i].lower);
  if (walls_[i].upper) result.upper = std::min(result.upper, start[i].upper);
  return result;
}

/// Puts the image into `box` if that lies in it, else enlarges the box.
bool VectorField::contract(std::span<const Interval> start, const Interval& time,
                           std::span<const Interval> derivative, double inflation, std::span<Interval> box) {
  bool inside = true;
  for (std::size_t i = 0; i < start.size(); ++i) {
    images_[i] = image(i, start, time, derivative[i]);
    if (is_inside(i, images_[i], box[i])) continue;
    if (inside) worst_ = i;
    inside = false;
  }
  for (std::size_t i = 0; i < start.size(); ++i) {
    const Interval& next = images_[i];
    box[i] = inside ? next : hull(box[i], clipped(i, inflated(start[i], next, inflation)));
  }
  return inside;
}

void VectorField::guess(std::span<const Interval> start, const Interval& time,
                        std::span<const Interval> derivative, std::span<Interval> box) {
  for (std::size_t i = 0; i < start.size(); ++i) {
    box[i] = clipped(i, inflated(start[i], image(i, start, time, derivative[i])));
  }
}

/// Only where f has both signs over the start it may point inward at a side and outward elsewhere. A wall at
/// a seam would hide the equations' value on it from the box.
/// @returns whether there are any
bool VectorField::find_walls(std::span<const Interval> start, std::span<const Interval> derivative,
                             std::span<Interval> box) {
  bool any = false;
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (derivative[i].lower > 0.0 || derivative[i].upper < 0.0 || has_seams(i)) continue;
    const Interval whole = box[i];
    // Layers just outside of the sides.
    box[i] = {start[i].lower - margin(start[i]), start[i].lower};
    const bool lower = is_wall(i, false, box);
    box[i] = {start[i].upper, start[i].upper + margin(start[i])};
    const bool upper = is_wall(i, true, box);
    walls_[i] = {lower, upper};
    box[i] = {lower ? start[i].lower - margin(start[i]) : whole.lower,
              upper ? start[i].upper + margin(start[i]) : whole.upper};
    any = any || lower || upper;
  }
  return any;
}

/// Whether f does not point out over `box`, a layer at a side of it.
bool VectorField::is_wall(std::size_t i, bool upper, std::span<Interval> box) {
  set_state(box);
  values_.run(tape_->values_of[i], slots_, pins_);
  const Interval& f = values_[tape_->outputs[i]];
  return f.total && (upper ? f.upper <= 0.0 : f.lower >= 0.0);
}

/// Whether the walls are walls for the final box too. Where f may be so steep that solutions leave a side
/// without reason, two walls could be passed at once, at a corner: then each must hold for states beyond
/// those that come after it.
bool VectorField::walls_hold(std::span<const Interval> start, std::span<Interval> box) {
  if (steep_) {
    for (std::size_t i = 0; i < box.size(); ++i) {
      if (walls_[i].lower) box[i].lower -= margin(box[i]);
      if (walls_[i].upper) box[i].upper += margin(box[i]);
    }
  }
  for (std::size_t i = 0; i < box.size(); ++i) {
    if (steep_) {
      if (walls_[i].lower) box[i].lower = start[i].lower;
      if (walls_[i].upper) box[i].upper = start[i].upper;
    }
    const Interval whole = box[i];
    bool hold = true;
    if (walls_[i].lower) {
      box[i] = {whole.lower - margin(whole), whole.lower};
      hold = is_wall(i, false, box);
    }
    if (walls_[i].upper && hold) {
      box[i] = {whole.upper, whole.upper + margin(whole)};
      hold = is_wall(i, true, box);
    }
    box[i] = whole;
    if (!hold) return false;
  }
  return true;
}

std::optional<FlowFailure> VectorField::enclose_solutions(std::span<const Interval> start,
                                                          const Interval& duration, std::span<Interval> box,
                                                          std::span<Interval> derivative) {
  const Interval time{0.0, duration.upper};
  if (const auto failure = evaluate(start, derivative)) return failure;
  std::fill(walls_.begin(), walls_.end(), Walls{});
  guess(start, time, derivative, box);
  if (find_walls(start, derivative, box)) {
    if (!iterate(start, time, box, derivative) && walls_hold(start, box)) return evaluate(box, derivative);
    std::fill(walls_.begin(), walls_.end(), Walls{});
    if (const auto failure = evaluate(start, derivative)) return failure;
    guess(start, time, derivative, box);
  }
  return iterate(start, time, box, derivative);
}

/// Enlarges the guess until it holds the solutions.
std::optional<FlowFailure> VectorField::iterate(std::span<const Interval> start, const Interval& time,
                                                std::span<Interval> box, std::span<Interval> derivative) {
  bool found = false;
  double inflation = kInflation;
  for (int n = 0; n < kIterations && !found; ++n) {
    if (const auto failure = evaluate(box, derivative)) return failure;
    found = contract(start, time, derivative, inflation, box);
    if (n >= kModestIterations) inflation *= 2.0;
  }
  if (!found) return FlowFailure{false, worst_};
  // The image is an enclosure too, and a tighter one; once more is worth its price.
  if (const auto failure = evaluate(box, derivative)) return failure;
  for (std::size_t i = 0; i < start.size(); ++i) box[i] = image(i, start, time, derivative[i]);
  return evaluate(box, derivative);
}

}  // namespace coordreq
