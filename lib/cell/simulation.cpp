#include "cell/simulation.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <numeric>

#include "choices/forbidden_choices.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

std::string outcome_name(Outcome outcome) {
  constexpr const char* kNames[] = {"completed",     "left_safely", "left_invariant", "no_action",
                                    "reached_goal",  "late",        "not_allowed",    "not_followed",
                                    "left_safe_set", "stuck",       "broke_promise"};
  return kNames[static_cast<std::size_t>(outcome)];
}

std::vector<Outcome> outcomes(const ProblemSpec& spec) {
  std::vector<Outcome> result;
  const auto add = [&result](bool is_possible, std::initializer_list<Outcome> some) {
    for (const Outcome outcome : some) {
      if (is_possible) result.push_back(outcome);
    }
  };
  add(true, {Outcome::completed, Outcome::left_safely, Outcome::left_invariant, Outcome::no_action,
             Outcome::not_followed});
  add(spec.silence.has_value(), {Outcome::left_safe_set, Outcome::stuck, Outcome::broke_promise});
  add(spec.goal.has_value(), {Outcome::reached_goal, Outcome::late});
  add(may_forbid_choices(spec), {Outcome::not_allowed});
  return result;
}

std::int64_t RunTrace::coordinated_steps() const {
  return std::count_if(steps.begin(), steps.end(), [](const Step& step) { return step.coordinated; });
}

std::int64_t RunTrace::longest_silence() const {
  std::int64_t longest = 0;
  std::int64_t current = 0;
  for (const Step& step : steps) {
    current = step.coordinated ? 0 : current + 1;
    longest = std::max(longest, current);
  }
  return longest;
}

std::int64_t RunTrace::outside_goal() const {
  return std::ranges::count_if(samples, [](const Sample& sample) { return !sample.in_goal; });
}

std::optional<std::int64_t> RunTrace::last_outside_goal() const {
  for (std::int64_t k = std::ssize(samples); k-- > 0;) {
    if (!samples[static_cast<std::size_t>(k)].in_goal) return k;
  }
  return std::nullopt;
}

std::optional<std::int64_t> RunTrace::longest_gap() const {
  std::optional<std::int64_t> visit, longest;
  for (std::int64_t k = 0; k < std::ssize(samples); ++k) {
    if (!samples[static_cast<std::size_t>(k)].in_goal) continue;
    if (visit) longest = std::max(longest.value_or(0), k - *visit);
    visit = k;
  }
  return longest;
}

double RunTrace::smallest_margin() const {
  double smallest = std::numeric_limits<double>::infinity();
  const std::size_t count = samples.size() - (outcome == Outcome::left_safely ? 1 : 0);
  for (std::size_t k = 0; k < count; ++k) smallest = std::min(smallest, samples[k].margin);
  return smallest;
}

std::int64_t Simulation::count(Outcome outcome) const {
  return std::count_if(traces.begin(), traces.end(),
                       [outcome](const RunTrace& trace) { return trace.outcome == outcome; });
}

std::int64_t Simulation::steps() const {
  return std::accumulate(traces.begin(), traces.end(), std::int64_t{0},
                         [](std::int64_t sum, const auto& trace) { return sum + std::ssize(trace.steps); });
}

std::int64_t Simulation::coordinated_steps() const {
  return std::accumulate(traces.begin(), traces.end(), std::int64_t{0},
                         [](std::int64_t sum, const auto& trace) { return sum + trace.coordinated_steps(); });
}

std::int64_t Simulation::longest_silence() const {
  std::int64_t longest = 0;
  for (const RunTrace& trace : traces) longest = std::max(longest, trace.longest_silence());
  return longest;
}

double Simulation::smallest_margin() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const RunTrace& trace : traces) smallest = std::min(smallest, trace.smallest_margin());
  return smallest;
}

std::optional<std::size_t> Simulation::failure() const {
  const bool is_lossy = partition.empty();
  const auto found = std::find_if(traces.begin(), traces.end(), [is_lossy](const RunTrace& trace) {
    if (trace.outcome == Outcome::not_followed) return true;
    return is_lossy ? trace.outcome == Outcome::no_action : is_violation(trace.outcome);
  });
  if (found == traces.end()) return std::nullopt;
  return static_cast<std::size_t>(found - traces.begin());
}

std::string policy_name(Policy policy) {
  constexpr const char* kNames[] = {"random", "adversarial", "prefer"};
  return kNames[static_cast<std::size_t>(policy)];
}

std::string disturbance_name(Disturbance disturbance) {
  constexpr const char* kNames[] = {"random", "extremes", "constant"};
  return kNames[static_cast<std::size_t>(disturbance)];
}

}  // namespace coordreq
