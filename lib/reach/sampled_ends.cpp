#include "reach/sampled_ends.hpp"

#include <algorithm>
#include <cmath>

#include "base/index.hpp"
#include "expression/dual.hpp"
#include "expression/evaluate.hpp"

namespace coordreq {
namespace {

/// Number of dimensions with corners of their own; further dimensions follow the last of these.
constexpr std::size_t kCornerDimensions = 6;
/// Against the step of the grid; nobody sees more.
constexpr double kSampleTolerance = 1e-6;
/// Sub-steps of the solutions from one box: those of a stiff system take a thousand each.
constexpr std::int64_t kMostTried = 2 * PointFlow::kFewSteps;

}  // namespace

SampledEnds::SampledEnds(const SystemSpec& spec)
    : spec_(&spec), flows_(spec.states.size()), slots_(spec.slot_count()) {
  for (std::size_t i = 0; i < spec.states.size(); ++i) dependencies_.push_back(find_dependencies(spec, i));
}

PointFlow& SampledEnds::flow_of(std::size_t state) {
  std::unique_ptr<PointFlow>& flow = flows_[state];
  if (!flow)
    flow = std::make_unique<PointFlow>(*spec_, dependencies_[state].moving, kSampleTolerance,
                                       PointFlow::kFewSteps);
  return *flow;
}

/// Takes in the solution from the values in `slots_`. @returns whether it is known
bool SampledEnds::add(std::size_t state, std::optional<Interval>& all) {
  double end = 0.0;
  if (spec_->dynamics.time == Time::discrete) {
    end = Evaluator<double>(spec_->dynamics.equations[state]).number(slots_);
  } else {
    const std::vector<std::int32_t>& moving = dependencies_[state].moving;
    const auto own = std::find(moving.begin(), moving.end(), static_cast<std::int32_t>(state));
    PointFlow& flow = flow_of(state);
    if (flow.tried() > most_tried_) return false;
    const auto ends = flow.after_period(slots_);
    if (!ends) return false;
    end = (*ends)[static_cast<std::size_t>(own - moving.begin())];
  }
  if (!std::isfinite(end)) return false;
  all = all ? hull(*all, Interval(end)) : Interval(end);
  return true;
}

std::optional<Interval> SampledEnds::next(std::size_t state, std::span<const Interval> slots) {
  if (spec_->dynamics.update(state) != nullptr) return std::nullopt;
  for (std::size_t s = 0; s < slots.size(); ++s) slots_[s] = midpoint(slots[s]);
  std::vector<std::uint32_t> wide;
  for (const std::int32_t j : dependencies_[state].moving) {
    if (!slots[spec_->state_slot(at(j))].is_point()) wide.push_back(spec_->state_slot(at(j)));
  }
  if (spec_->dynamics.time == Time::continuous) most_tried_ = flow_of(state).tried() + kMostTried;
  const std::vector<std::int32_t>& disturbances = dependencies_[state].disturbances;
  std::optional<Interval> all;
  for (int side = disturbances.empty() ? 1 : 0; side <= (disturbances.empty() ? 1 : 2); ++side) {
    for (const std::int32_t l : disturbances) {
      const DisturbanceSpec& w = spec_->disturbances[at(l)];
      slots_[spec_->disturbance_slot(at(l))] = nearest_double(w.lower + (w.upper - w.lower) * side / 2);
    }
    if (!add(state, all)) return std::nullopt;
    for (const std::uint32_t slot : wide) {
      for (const double end : {slots[slot].lower, slots[slot].upper}) {
        slots_[slot] = end;
        if (!add(state, all)) return std::nullopt;
      }
      slots_[slot] = midpoint(slots[slot]);
    }
    const std::size_t free = std::min(wide.size(), kCornerDimensions);
    for (std::size_t corner = 0; wide.size() > 1 && corner < (std::size_t{1} << free); ++corner) {
      for (std::size_t d = 0; d < wide.size(); ++d) {
        const bool upper = ((corner >> std::min(d, free - 1)) & 1U) != 0;
        slots_[wide[d]] = upper ? slots[wide[d]].upper : slots[wide[d]].lower;
      }
      if (!add(state, all)) return std::nullopt;
    }
    for (const std::uint32_t slot : wide) slots_[slot] = midpoint(slots[slot]);
  }
  return all;
}

}  // namespace coordreq
