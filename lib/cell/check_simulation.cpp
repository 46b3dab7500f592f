#include "cell/check_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "answers/countdown/kinds.hpp"
#include "answers/plan.hpp"
#include "answers/step_codes.hpp"
#include "base/error.hpp"
#include "cell/state_text.hpp"
#include "model/locate.hpp"
#include "model/sample_reset.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// No state is beyond a `stop` limit, and none is measured farther than the error from it.
bool is_beyond_limit(const GridDimension& dimension, const Rational& value) {
  const Rational& error = dimension.measurement_error;
  return (dimension.below == Outside::stop && value < dimension.first - error) ||
         (dimension.above == Outside::stop && value > dimension.point(dimension.count - 1) + error);
}

void check_prefer(const ProblemSpec& spec, Policy policy) {
  const auto has_prefer = [](const AgentSpec& agent) { return agent.prefer.has_value(); };
  if (policy != Policy::prefer || std::any_of(spec.agents.begin(), spec.agents.end(), has_prefer)) return;
  throw UsageError("no agent of the spec has a 'prefer'", "--policy");
}

/// Agents that follow a policy on request have no other choice: refuses options that say otherwise.
void check_kind(const ProblemSpec& spec, const SimulationOptions& options) {
  if (options.kind == nullptr) return;
  const CountdownOption& option = options.kind->option;
  const auto is_of_kind = [&](const AnswerPolicy& policy) { return policy.kind == options.kind; };
  if (std::ranges::none_of(answer_policies(spec), is_of_kind)) throw UsageError(option.missing, option.name);
  const auto refuse = [](bool is_given, const char* error, const char* other) {
    if (is_given && error != nullptr) throw UsageError(error, other);
  };
  refuse(options.policy == Policy::prefer, option.no_prefer, "--policy");
  refuse(options.until_goal, option.no_until, "--until");
  refuse(options.is_lossy, option.no_lossy, "--lossy");
}

}  // namespace

void check_options(const ProblemSpec& spec, const SimulationOptions& options) {
  check_kind(spec, options);
  check_prefer(spec, options.policy);
  if (options.until_goal && !spec.goal) throw UsageError("the spec has no goal", "--until");
  if (options.until_goal && spec.is_goal_lasting())
    throw UsageError("runs do not end in a goal to stay at or to return to", "--until");
}

std::vector<Rational> start_state(const ResultsReader& results, const std::string& text) {
  std::vector<Rational> state = parse_state(text, state_names(results.spec()), "--from");
  for (std::size_t i = 0; i < state.size(); ++i) {
    const GridDimension& dimension = results.grid()[i];
    if (dimension.periodic()) state[i] = reset_at_sample(dimension, state[i]);
  }
  return state;
}

void check_start(const ResultsReader& results, const std::vector<Rational>& state,
                 std::span<const std::int32_t> delays, const CountdownKind* kind) {
  const Location location = locate(results.grid(), state);
  std::optional<std::size_t> fault;
  if (location.kind != Location::Kind::cell) fault = location.dimension;
  for (std::size_t i = 0; i < state.size() && !fault; ++i) {
    if (is_beyond_limit(results.grid()[i], state[i])) fault = i;
  }
  if (fault) {
    const bool off_grid = location.kind == Location::Kind::off_grid;
    throw UsageError(fmt::format("{} = {} is {}", results.grid()[*fault].name, to_text(state[*fault]),
                                 off_grid ? "not a value of this discrete state" : "outside of the domain"),
                     "--from");
  }
  const std::int32_t steps = delays[static_cast<std::size_t>(location.cell)];
  if (steps < 0) {
    throw UsageError(steps == kOutsideSafe ? "the start is not in the safe set"
                     : kind != nullptr && kind->option.no_start != nullptr
                         ? kind->option.no_start
                         : "the start is not in the invariance set: on this grid not even coordination keeps "
                           "the system safe from there",
                     "--from");
  }
}

}  // namespace coordreq
