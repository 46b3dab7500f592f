#include <map>
#include <memory>
#include <string>
#include <utility>

#include "answers/risk/policy.hpp"
#include "answers/silence/answer.hpp"
#include "cell/closed_loop.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

std::vector<std::shared_ptr<ActionChooser>> ClosedLoop::choosers_of_modes() {
  std::vector<std::shared_ptr<ActionChooser>> result;
  std::map<std::string, std::shared_ptr<ActionChooser>> known;
  if (problem_.network == nullptr) return result;
  for (std::size_t mode = 0; mode < problem_.network->modes().size(); ++mode) {
    const LossyNetwork::Mode& network_mode = problem_.network->modes()[mode];
    const bool is_safest = network_mode.is_connected && !problem_.mode_values.empty();
    LoopProblem of_mode = problem_;
    of_mode.partition = network_mode.partition;
    of_mode.policies.resize(1);
    if (is_safest) {
      of_mode.policies.front() = safest_policy(problem_.policies.front().delay);
      for (const auto& [path, cells] : problem_.mode_values[mode]) of_mode.values[path] = cells;
    }
    if (!network_mode.is_connected && problem_.spec->silence) {
      const std::string delay = of_mode.policies.front().delay;
      of_mode.policies = silence_policies(*problem_.spec);
      of_mode.policies.front().delay = delay;
    }
    std::shared_ptr<ActionChooser>& chooser =
        known[network_mode.partition->canonical + (is_safest ? " " + std::to_string(mode) : "")];
    if (!chooser) chooser = std::make_shared<ActionChooser>(of_mode, options_.policy, dynamics_, controller_);
    result.push_back(chooser);
  }
  return result;
}

RunTrace ClosedLoop::run_lossy(std::vector<Rational> measured, std::uint64_t run) {
  RandomStream actions(options_.seed, run, RandomStream::Purpose::actions);
  RandomStream disturbances(options_.seed, run, RandomStream::Purpose::disturbances);
  RandomStream losses(options_.seed, run, RandomStream::Purpose::losses);
  const std::vector<LossyNetwork::Mode>& modes = problem_.network->modes();
  State state = first_state(std::move(measured), draw_nature(disturbances));
  std::size_t mode = problem_.spec->risk ? problem_.spec->risk->start : 0;
  if (problem_.spec->risk && problem_.spec->risk->is_drawn) mode = problem_.network->draw(mode, losses);
  RunTrace trace;
  const auto add = [&] { add_sample(state, trace).countdown = modes[mode].is_connected ? 0 : 1; };
  const auto end = [&trace](Outcome outcome) {
    trace.outcome = outcome;
    return trace;
  };
  add();
  for (std::int64_t k = 0; k < options_.steps; ++k) {
    if (is_at_end(trace)) return end(Outcome::reached_goal);
    const std::int64_t cell = state.place.cell;
    const Nature nature = draw_nature(disturbances);
    next_.begin(state.exact, nature.disturbance, nature.error, cell);
    ActionChooser& chooser = *mode_choosers_[mode];
    const std::int32_t countdown = trace.samples.back().countdown;
    const std::optional<std::int64_t> u =
        chooser.choose(cell, state.measured, {.policy = 0, .countdown = countdown}, next_, actions);
    const bool is_told = !modes[mode].is_connected && problem_.spec->silence;
    if (!u) return end(is_told ? Outcome::stuck : Outcome::no_action);
    if (chooser.forbids(cell, *u)) return end(Outcome::not_allowed);
    std::vector<double> disturbance;
    for (const Rational& value : nature.disturbance) disturbance.push_back(nearest_double(value));
    trace.steps.push_back({*u, countdown == 0, std::move(disturbance)});
    const bool known = advance(state, *u, nature);
    mode = problem_.network->draw(mode, losses);
    add();
    if (state.place.kind == Location::Kind::left_safely) {
      return end(is_at_end(trace) ? Outcome::reached_goal : Outcome::left_safely);
    }
    if (!known || trace.samples.back().delay < 0) return end(Outcome::left_invariant);
  }
  return end(is_at_end(trace) ? Outcome::reached_goal : Outcome::completed);
}

}  // namespace coordreq
