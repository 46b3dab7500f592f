#include "cell/next_margin.hpp"

#include <algorithm>
#include <utility>

#include "base/index.hpp"
#include "base/requires.hpp"
#include "cell/smallest_score.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// The inputs that states depend on.
InputClass inputs_behind(const std::vector<std::size_t>& states, const InputSpace& space,
                         const PointDynamics& dynamics) {
  std::vector<std::int32_t> inputs;
  for (const std::size_t i : states) {
    for (const std::int32_t j : dynamics.dependencies(i).inputs) {
      if (!contains(inputs, j)) inputs.push_back(j);
    }
  }
  InputClass result(space, std::move(inputs));
  if (space.count() <= NextStates::kMostTabulated) result.tabulate();
  return result;
}

}  // namespace

NextMargin::NextMargin(const ProblemSpec& spec, const InputSpace& space, const PointDynamics& dynamics)
    : spec_(&spec),
      margin_(spec.safe),
      inputs_(space, {}),
      differences_(margin_.comparisons()),
      slots_(spec.slot_count()),
      doubles_(spec.slot_count()) {
  const auto states_among = [&spec](const std::vector<std::uint32_t>& slots) {
    std::vector<std::size_t> states;
    for (std::size_t i = 0; i < spec.states.size(); ++i) {
      if (contains(slots, spec.state_slot(i))) states.push_back(i);
    }
    return states;
  };
  inputs_ = inputs_behind(states_among(spec.safe.variables()), space, dynamics);
  is_of_all_inputs_ = inputs_.actions() == space.count();
  for (std::size_t c = 0; c < margin_.comparisons(); ++c) {
    std::vector<std::size_t> states = states_among(margin_.variables(c));
    InputClass inputs = inputs_behind(states, space, dynamics);
    comparisons_.push_back({.states = std::move(states), .inputs = std::move(inputs)});
  }
}

std::int64_t NextMargin::smallest(NextStates& next, const Numbers& candidates) {
  REQUIRES(!candidates.empty());
  for (Comparison& comparison : comparisons_) {
    comparison.approximate.clear();
    comparison.exact.clear();
  }
  return smallest_score(
      distinct(next, candidates), [&](std::int64_t u) { return approximate(next, u); },
      [&](std::int64_t u) { return exact(next, u); });
}

/// Of all candidates that lead to the same values where the margin looks the one with the smallest number.
NextMargin::Numbers NextMargin::distinct(NextStates& next, const Numbers& candidates) const {
  if (is_of_all_inputs_) return candidates;
  constexpr std::int64_t kUnknown = -1;
  std::vector<std::pair<std::int64_t, std::int64_t>> by_action;
  by_action.reserve(candidates.size());
  for (const std::int64_t u : candidates)
    by_action.emplace_back(next.is_known(u) ? inputs_.action(u) : kUnknown, u);
  std::sort(by_action.begin(), by_action.end());
  const auto end = std::unique(by_action.begin(), by_action.end(),
                               [](const auto& a, const auto& b) { return a.first == b.first; });
  Numbers result;
  for (auto at = by_action.begin(); at != end; ++at) result.push_back(at->second);
  return result;
}

double NextMargin::approximate(NextStates& next, std::int64_t u) {
  if (!next.is_known(u)) return -outward::kInfinity;
  for (std::size_t c = 0; c < comparisons_.size(); ++c) {
    Comparison& comparison = comparisons_[c];
    const auto [found, is_new] = comparison.approximate.try_emplace(comparison.inputs.action(u));
    if (is_new) {
      for (const std::size_t i : comparison.states)
        doubles_[spec_->state_slot(i)] = next.state(i, u).approximate;
      found->second = margin_.approximate_difference(c, doubles_);
    }
    differences_[c] = found->second;
  }
  return margin_.of_differences(differences_);
}

double NextMargin::exact(NextStates& next, std::int64_t u) {
  if (!next.is_known(u)) return -outward::kInfinity;
  for (std::size_t c = 0; c < comparisons_.size(); ++c) {
    Comparison& comparison = comparisons_[c];
    const auto [found, is_new] = comparison.exact.try_emplace(comparison.inputs.action(u));
    if (is_new) {
      for (const std::size_t i : comparison.states) slots_[spec_->state_slot(i)] = next.state(i, u).value;
      found->second = margin_.difference(c, slots_);
    }
    differences_[c] = found->second;
  }
  return margin_.of_differences(differences_);
}

}  // namespace coordreq
