#include <algorithm>
#include <limits>
#include <utility>

#include "answers/step_codes.hpp"
#include "cell/closed_loop.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

RunTrace ClosedLoop::run_silent(std::vector<Rational> measured, std::uint64_t run) {
  RandomStream actions(options_.seed, run, RandomStream::Purpose::actions);
  RandomStream disturbances(options_.seed, run, RandomStream::Purpose::disturbances);
  const std::span<const std::int32_t> silence = problem_.values.at(problem_.policies[1].delay);
  const bool has_then = problem_.policies.size() > 2;
  State state = first_state(std::move(measured), draw_nature(disturbances));
  const std::int64_t promised = silence[static_cast<std::size_t>(state.place.cell)];
  const bool is_for_ever = promised == kUnbounded || *options_.silent_steps <= promised;
  RunTrace trace;
  const auto add = [&] {
    const auto k = static_cast<std::int64_t>(trace.samples.size());
    const bool is_silent = *options_.silent_steps == kUnbounded;
    add_sample(state, trace).countdown =
        is_silent ? kUnbounded
                  : static_cast<std::int32_t>(std::max<std::int64_t>(0, *options_.silent_steps - k));
  };
  // Whether the promise is about the sample `later` steps from now on.
  const auto end = [&](Outcome outcome, std::int64_t later) {
    const std::int64_t sample = static_cast<std::int64_t>(trace.samples.size()) - 1 + later;
    const bool is_promised = is_for_ever || sample <= promised;
    const bool is_end = outcome == Outcome::left_safe_set || outcome == Outcome::stuck;
    trace.outcome = is_end && is_promised ? Outcome::broke_promise : outcome;
    return trace;
  };
  add();
  for (std::int64_t k = 0; k < options_.steps; ++k) {
    if (is_at_end(trace)) return end(Outcome::reached_goal, 0);
    const std::int64_t cell = state.place.cell;
    const Nature nature = draw_nature(disturbances);
    next_.begin(state.exact, nature.disturbance, nature.error, cell);
    const bool is_silent = k < *options_.silent_steps;
    const bool is_coordinated = !is_silent && !has_then;
    const std::size_t policy = is_silent ? 1 : has_then ? 2 : 0;
    const std::optional<std::int64_t> u = chooser_.choose(
        cell, state.measured, {.policy = policy, .countdown = is_coordinated ? 0 : 1}, next_, actions);
    if (!u || (!is_coordinated && chooser_.forbids(cell, *u))) return end(Outcome::stuck, 1);
    if (!next_.is_known(*u) && !next_.has_left(*u)) {
      trace.followed = next_.followed(*u);
      return end(Outcome::not_followed, 0);
    }
    std::vector<double> disturbance;
    for (const Rational& value : nature.disturbance) disturbance.push_back(nearest_double(value));
    trace.steps.push_back({*u, is_coordinated, std::move(disturbance)});
    const bool known = advance(state, *u, nature);
    add();
    if (state.place.kind == Location::Kind::left_safely)
      return end(is_at_end(trace) ? Outcome::reached_goal : Outcome::left_safely, 0);
    const bool is_safe = known && state.place.kind == Location::Kind::cell &&
                         silence[static_cast<std::size_t>(state.place.cell)] != kOutsideSafe;
    if (!is_safe) return end(Outcome::left_safe_set, 0);
  }
  return end(is_at_end(trace) ? Outcome::reached_goal : Outcome::completed, 0);
}

}  // namespace coordreq
