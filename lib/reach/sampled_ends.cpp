#include "reach/sampled_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/index.hpp"
#include "expression/dual.hpp"
#include "expression/evaluate.hpp"

namespace coordreq {
namespace {

/// Number of dimensions with corners of their own; further dimensions follow the last of these.
constexpr std::size_t kCornerDimensions = 6;
/// Relative to the step of the grid; less makes no difference.
constexpr double kSampleTolerance = 1e-6;
/// Sub-steps of the solutions from one box: those of a stiff system take a thousand each.
constexpr std::int64_t kMostTried = 2 * PointFlow::kFewSteps;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

SampledEnds::SampledEnds(const SystemSpec& spec)
    : spec_(&spec), flows_(spec.states.size()), slots_(spec.slot_count()) {
  for (std::size_t i = 0; i < spec.states.size(); ++i) dependencies_.push_back(find_dependencies(spec, i));
}

PointFlow& SampledEnds::flow() {
  std::unique_ptr<PointFlow>& flow = flows_[state_];
  if (!flow)
    flow = std::make_unique<PointFlow>(*spec_, dependencies_[state_].moving, kSampleTolerance,
                                       PointFlow::kFewSteps);
  return *flow;
}

/// Takes in the solution from the values in `slots_`.
void SampledEnds::add() {
  std::optional<std::vector<double>> ends;
  if (spec_->dynamics.time == Time::discrete) {
    ends.emplace(1, Evaluator<double>(spec_->dynamics.equations[state_]).number(slots_));
  } else {
    if (flow().tried() <= most_tried_) ends = flow().after_period(slots_);
  }
  const bool is_first = ends_.empty();
  if (is_first) ends_.resize(ends_of_.size());
  for (std::size_t k = 0; k < ends_.size(); ++k) {
    const double end = ends ? (*ends)[k] : kUnknown;
    if (is_first || !std::isfinite(end)) {
      ends_[k] = {end, end};
    } else if (ends_[k].is_finite()) {
      ends_[k] = hull(ends_[k], Interval(end));
    }
  }
}

bool SampledEnds::is_followed(std::size_t state, std::span<const Interval> slots) const {
  if (state_ == SIZE_MAX || std::ranges::find(ends_of_, static_cast<std::int32_t>(state)) == ends_of_.end())
    return false;
  return dependencies_[state].moving == dependencies_[state_].moving &&
         dependencies_[state].disturbances == dependencies_[state_].disturbances &&
         std::ranges::equal(slots, boxes_, [](const Interval& a, const Interval& b) {
           return a.lower == b.lower && a.upper == b.upper;
         });
}

void SampledEnds::follow(std::size_t state, std::span<const Interval> slots) {
  state_ = state;
  boxes_.assign(slots.begin(), slots.end());
  ends_.clear();
  if (spec_->dynamics.time == Time::discrete) {
    ends_of_.assign(1, static_cast<std::int32_t>(state));
  } else {
    ends_of_ = dependencies_[state].moving;
  }
  for (std::size_t s = 0; s < slots.size(); ++s) slots_[s] = midpoint(slots[s]);
  std::vector<std::uint32_t> wide;
  for (const std::int32_t j : dependencies_[state].moving) {
    if (!slots[spec_->state_slot(at(j))].is_point()) wide.push_back(spec_->state_slot(at(j)));
  }
  if (spec_->dynamics.time == Time::continuous) most_tried_ = flow().tried() + kMostTried;
  const auto is_known = [this] {
    return std::ranges::any_of(ends_, [](const Interval& end) { return end.is_finite(); });
  };
  const std::vector<std::int32_t>& disturbances = dependencies_[state].disturbances;
  for (int side = disturbances.empty() ? 1 : 0; side <= (disturbances.empty() ? 1 : 2); ++side) {
    for (const std::int32_t l : disturbances) {
      const DisturbanceSpec& w = spec_->disturbances[at(l)];
      slots_[spec_->disturbance_slot(at(l))] = nearest_double(w.lower + (w.upper - w.lower) * side / 2);
    }
    add();
    for (const std::uint32_t slot : wide) {
      for (const double end : {slots[slot].lower, slots[slot].upper}) {
        if (!is_known()) return;
        slots_[slot] = end;
        add();
      }
      slots_[slot] = midpoint(slots[slot]);
    }
    const std::size_t free = std::min(wide.size(), kCornerDimensions);
    for (std::size_t corner = 0; wide.size() > 1 && corner < (std::size_t{1} << free); ++corner) {
      for (std::size_t d = 0; d < wide.size(); ++d) {
        const bool upper = ((corner >> std::min(d, free - 1)) & 1U) != 0;
        slots_[wide[d]] = upper ? slots[wide[d]].upper : slots[wide[d]].lower;
      }
      if (!is_known()) return;
      add();
    }
    for (const std::uint32_t slot : wide) slots_[slot] = midpoint(slots[slot]);
  }
}

std::optional<Interval> SampledEnds::next(std::size_t state, std::span<const Interval> slots) {
  if (spec_->dynamics.update(state) != nullptr) return std::nullopt;
  if (!is_followed(state, slots)) follow(state, slots);
  const auto found = std::ranges::find(ends_of_, static_cast<std::int32_t>(state));
  const Interval& end = ends_[at(found - ends_of_.begin())];
  return end.is_finite() ? std::optional(end) : std::nullopt;
}

}  // namespace coordreq
