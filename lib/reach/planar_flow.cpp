#include "reach/planar_flow.hpp"

#include <algorithm>
#include <cmath>

#include "base/requires.hpp"

namespace coordreq {
namespace {

/// Coefficients that are off by more of what they lead to are not followed.
constexpr double kMostOff = 1e-14;
/// A disturbance more doubles the work and more.
constexpr std::size_t kMostCorners = 8;
/// A step is as long as the fastest turn takes for this angle.
constexpr double kTurn = 0.05;
constexpr double kMostTurns = 400.0;
constexpr double kLeastSteps = 8.0;
/// What sides that are left out may add in a period, as a part of the width of the initial box, or of all
/// that is reached where that is a point.
constexpr double kPlanarTolerance = 0.1;
constexpr double kPlanarToleranceOfPoint = 0.01;

Interval scaled(const Interval& a, int power) {
  return {std::ldexp(a.lower, power), std::ldexp(a.upper, power), a.total};
}

/// The degree of an expression in all states together, then in each disturbance; 2 stands for anything else.
using Degrees = std::vector<int>;

constexpr int kMany = 2;

class DegreeFinder {
 public:
  explicit DegreeFinder(const FlowSystem& system) : count_(1 + system.disturbance_slots.size()) {
    for (const std::uint32_t slot : system.state_slots) moving_.emplace_back(slot, 0);
    for (std::size_t l = 0; l + 1 < count_; ++l) moving_.emplace_back(system.disturbance_slots[l], l + 1);
  }

  [[nodiscard]] bool is_bilinear(const FlowTape& tape) {
    for (const FlowTape::Node& node : tape.nodes) degrees_.push_back(degrees_of(node));
    return std::all_of(tape.outputs.begin(), tape.outputs.end(), [&](std::uint32_t output) {
      const Degrees& found = degrees_[output];
      return std::all_of(found.begin(), found.end(), [](int degree) { return degree < kMany; });
    });
  }

 private:
  static bool is_fixed(const Degrees& a) {
    return std::all_of(a.begin(), a.end(), [](int degree) { return degree == 0; });
  }

  template <class Combine>
  [[nodiscard]] Degrees combined(const FlowTape::Node& node, Combine combine) const {
    Degrees result(count_);
    std::transform(degrees_[node.a].begin(), degrees_[node.a].end(), degrees_[node.b].begin(), result.begin(),
                   combine);
    return result;
  }

  [[nodiscard]] Degrees degrees_of(const FlowTape::Node& node) const {
    Degrees result(count_);
    switch (node.op) {
      case Operator::variable:
        for (const auto& [slot, place] : moving_) {
          if (slot == node.a) result[place] = 1;
        }
        return result;
      case Operator::negate:
        return degrees_[node.a];
      case Operator::add:
      case Operator::subtract:
        return combined(node, [](int a, int b) { return std::max(a, b); });
      case Operator::multiply:
        return combined(node, [](int a, int b) { return std::min(a + b, kMany); });
      case Operator::divide:
        if (is_fixed(degrees_[node.b])) return degrees_[node.a];
        break;
      default:
        break;
    }
    const std::size_t operands = operand_count(node.op);
    const bool fixed = (operands < 1 || is_fixed(degrees_[node.a])) &&
                       (operands < 2 || is_fixed(degrees_[node.b])) &&
                       (operands < 3 || is_fixed(degrees_[node.c]));
    if (!fixed) std::fill(result.begin(), result.end(), kMany);
    return result;
  }

  std::size_t count_;
  std::vector<std::pair<std::uint32_t, std::size_t>> moving_;  ///< slots, and their place in Degrees
  std::vector<Degrees> degrees_;
};

bool has_form(const FlowSystem& system, const FlowTape& tape) {
  const auto has_limits = [](const FlowSystem::Limit& limit) { return limit.below || limit.above; };
  const auto has_seams = [](const std::vector<Interval>& seams) { return !seams.empty(); };
  return system.equations.size() == 2 && !tape.affine &&
         std::none_of(system.stops.begin(), system.stops.end(), has_limits) &&
         std::none_of(system.seams.begin(), system.seams.end(), has_seams) &&
         DegreeFinder(system).is_bilinear(tape);
}

}  // namespace

PlanarFlow::PlanarFlow(const FlowSystem& system, const FlowTape& tape)
    : system_(&system),
      tape_(&tape),
      applies_(has_form(system, tape)),
      values_(tape),
      slots_(system.slot_count) {}

void PlanarFlow::narrow(std::span<const Interval> slots, const Interval& period, FlowEnclosure& known) {
  REQUIRES(applies_);
  std::array<Interval, 2> start;
  for (const std::size_t i : {0U, 1U}) {
    const Interval& tube = known.tube[i];
    const double size = std::max(tube.magnitude(), 1e-200);
    if (!tube.is_finite() || size > 1e200) return;
    scale_[i] = -std::ilogb(size);
    tube_[i] = scaled(tube, scale_[i]);
    start[i] = scaled(slots[system_->state_slots[i]], scale_[i]);
  }
  if (!find_corners(slots) || !find_bounds() || !follow(start, period)) return;
  for (const std::size_t i : {0U, 1U}) {
    const Interval end = scaled(end_[i], -scale_[i]);
    known.end[i] = intersect(known.end[i], end).value_or(known.end[i]);
    known.tube[i] = intersect(known.tube[i], scaled(tube_[i], -scale_[i])).value_or(known.tube[i]);
  }
}

/// The equations at all vertices of the disturbances' box.
bool PlanarFlow::find_corners(std::span<const Interval> slots) {
  for (std::size_t s = 0; s < slots.size(); ++s) slots_[s] = Dual::constant(slots[s]);
  std::vector<std::uint32_t> wide;
  for (const std::uint32_t slot : system_->disturbance_slots) {
    if (!slots[slot].is_point()) wide.push_back(slot);
  }
  corners_.clear();
  const std::size_t count = std::size_t{1} << std::min<std::size_t>(wide.size(), 10);
  if (count > kMostCorners) return false;
  values_.run_fixed(slots_);
  for (std::size_t corner = 0; corner < count; ++corner) {
    for (std::size_t l = 0; l < wide.size(); ++l) {
      const Interval& range = slots[wide[l]];
      slots_[wide[l]] = Dual::constant(Interval((corner >> l & 1U) != 0 ? range.upper : range.lower));
    }
    if (!add_corner()) return false;
  }
  return true;
}

/// f at the origin, with its derivatives, which do not depend on the states.
bool PlanarFlow::add_corner() {
  Corner corner;
  const auto run = [&](bool at_origin, auto use) {
    for (const std::size_t j : {0U, 1U}) {
      const Interval range = at_origin ? Interval(0.0) : scaled(tube_[j], -scale_[j]);
      slots_[system_->state_slots[j]] = Dual::variable(range, j);
    }
    values_.run_moving(slots_);
    bool fine = true;
    for (const std::size_t i : {0U, 1U}) {
      const Dual& value = values_[tape_->outputs[i]];
      fine = fine && value.total && value.value.total && value.jump.upper == 0.0;
      use(i, value);
    }
    return fine;
  };
  const bool has_slopes = run(false, [&](std::size_t i, const Dual& value) {
    for (const std::size_t j : {0U, 1U}) {
      const Interval slope = j < value.directions ? value.gradient[j] : Interval(0.0);
      corner.matrix[i][j] = scaled(slope, scale_[i] - scale_[j]);
    }
  });
  const bool has_constants = run(
      true, [&](std::size_t i, const Dual& value) { corner.constant[i] = scaled(value.value, scale_[i]); });
  corners_.push_back(corner);
  return has_slopes && has_constants;
}

/// What solutions in the tube do, so that rounding can be told from it. @returns whether all is known so well
bool PlanarFlow::find_bounds() {
  bounds_ = {};
  speed_ = {};
  fastest_turn_ = 0.0;
  for (const Corner& corner : corners_) {
    double square = 0.0;
    for (const std::size_t i : {0U, 1U}) {
      speed_[i] = hull(speed_[i], times(corner, i, tube_) + corner.constant[i]);
      for (const Interval& entry : corner.matrix[i]) square += entry.magnitude() * entry.magnitude();
    }
    fastest_turn_ = std::max(fastest_turn_, std::sqrt(square));
  }
  for (const std::size_t i : {0U, 1U}) {
    bounds_.size[i] = tube_[i].magnitude();
    bounds_.speed[i] = speed_[i].magnitude();
  }
  bounds_.change = changes(tube_);
  return std::all_of(corners_.begin(), corners_.end(),
                     [this](const Corner& corner) { return is_exact(corner); });
}

/// The largest |A' (A x + b)| over a box, A and A' of any corners.
TurningPolygon::Vector PlanarFlow::changes(const std::array<Interval, 2>& box) const {
  std::array<Interval, 2> speed{};
  for (const Corner& corner : corners_) {
    for (const std::size_t i : {0U, 1U})
      speed[i] = hull(speed[i], times(corner, i, box) + corner.constant[i]);
  }
  TurningPolygon::Vector result{};
  for (const Corner& corner : corners_) {
    for (const std::size_t i : {0U, 1U}) result[i] = std::max(result[i], times(corner, i, speed).magnitude());
  }
  return result;
}

Interval PlanarFlow::times(const Corner& corner, std::size_t i, const std::array<Interval, 2>& x) {
  return corner.matrix[i][0] * x[0] + corner.matrix[i][1] * x[1];
}

/// Up to what counts as rounding.
bool PlanarFlow::is_exact(const Corner& corner) const {
  for (const std::size_t i : {0U, 1U}) {
    if (!(corner.constant[i].width() <= kMostOff * bounds_.speed[i])) return false;
    for (const std::size_t j : {0U, 1U}) {
      const double off = corner.matrix[i][j].width();
      if (!(off * bounds_.size[j] <= kMostOff * bounds_.speed[i])) return false;
      if (!(off * bounds_.speed[j] <= kMostOff * bounds_.change[i])) return false;
    }
  }
  return true;
}

void PlanarFlow::begin(const std::array<Interval, 2>& start, double steps) {
  std::vector<TurningPolygon::Corner> corners(corners_.size());
  for (std::size_t c = 0; c < corners.size(); ++c) {
    for (const std::size_t i : {0U, 1U}) {
      corners[c].constant[i] = midpoint(corners_[c].constant[i]);
      for (const std::size_t j : {0U, 1U}) corners[c].matrix[i][j] = midpoint(corners_[c].matrix[i][j]);
    }
  }
  TurningPolygon::Vector tolerance{};
  for (const std::size_t i : {0U, 1U}) {
    const bool is_point = start[i].is_point();
    tolerance[i] =
        (is_point ? kPlanarToleranceOfPoint * tube_[i].width() : kPlanarTolerance * start[i].width()) / steps;
  }
  polygon_.begin(corners, bounds_, start, tolerance);
}

/// @returns whether `end_` and `tube_` hold what was found
bool PlanarFlow::follow(const std::array<Interval, 2>& start, const Interval& period) {
  const double steps = std::max(std::ceil(fastest_turn_ * period.upper / kTurn), kLeastSteps);
  if (!(steps <= kMostTurns)) return false;
  begin(start, steps);
  const double h = outward::next_down(period.lower / steps);
  std::array<Interval, 2> swept = start;
  for (double step = 0.0; step < steps; ++step) {
    std::array<Interval, 2> during = polygon_.box();
    for (const std::size_t i : {0U, 1U}) {
      during[i] = during[i] + Interval{0.0, h} * speed_[i];
      during[i] = intersect(during[i], tube_[i]).value_or(tube_[i]);
      swept[i] = hull(swept[i], during[i]);
    }
    if (!polygon_.step(h, changes(during))) return false;
  }
  end_ = polygon_.box();
  const Interval rest{0.0, outward::add_up(period.upper, -outward::multiply_down(steps, h))};
  for (const std::size_t i : {0U, 1U}) {
    end_[i] = end_[i] + rest * speed_[i];
    tube_[i] = hull(swept[i], end_[i]);
  }
  return true;
}

}  // namespace coordreq
