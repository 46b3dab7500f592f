#include "cell/schedule.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "answers/risk/policy.hpp"
#include "answers/silence/answer.hpp"
#include "answers/step_codes.hpp"
#include "base/index.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Agents that stay silent for as long as they can.
class SelfTriggered final : public Schedule {
 public:
  SelfTriggered(const LoopProblem& problem, Policy policy, PointDynamics& dynamics, KeptInputs& controller)
      : problem_(problem), chooser_(problem, policy, dynamics, controller) {}

  std::int32_t begin(const RunTrace& trace, RandomStream /*losses*/) override {
    policy_ = policy_at(trace);
    promised_ = has_aim() && !is_lasting() ? trace.samples.front().arrival : kUnbounded;
    // On request no step has been agreed yet.
    return countdown_ = problem_.policies[policy_].is_on_request() ? 0 : begin_countdown(trace);
  }

  std::int32_t arrive(const RunTrace& trace) override {
    if (countdown_ != 0) return countdown_ = one_less(countdown_);
    const std::int64_t before = trace.samples[trace.steps.size() - 1].cell;
    const auto agreed = chooser_.countdown_after(policy_, before, trace.steps.back().input);
    policy_ = policy_at(trace);
    return countdown_ = agreed ? reset(*agreed) : begin_countdown(trace);
  }

  /// Agents that coordinate follow the policy that holds here, whichever countdown ended here.
  Turn turn(const RunTrace& trace) override {
    if (countdown_ == 0) policy_ = policy_at(trace);
    if (is_through(policy_, trace)) policy_ = 0;
    is_aimed_ = is_lasting() && has_aim();
    return {chooser_, {.policy = policy_, .countdown = countdown_}};
  }

  [[nodiscard]] std::optional<Outcome> fault(const RunTrace& trace) const override {
    if (trace.samples.back().delay < 0) return Outcome::left_invariant;
    const bool is_late = !trace.arrived && std::ssize(trace.steps) >= promised_;
    if (is_late || (is_aimed_ && !is_step_of_aim(trace))) return Outcome::late;
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool is_lasting() const { return problem_.spec->is_goal_lasting(); }
  [[nodiscard]] bool has_aim() const { return !problem_.policies[policy_].aim.path.empty(); }
  /// Nothing more follows from the aim of a policy.
  [[nodiscard]] bool is_through(std::size_t policy, const RunTrace& trace) const {
    const AnswerPolicy::Aim& aim = problem_.policies[policy].aim;
    return !aim.path.empty() && !aim.lasts && trace.arrived;
  }

  /// The policy that is followed from the last sample on.
  [[nodiscard]] std::size_t policy_at(const RunTrace& trace) {
    const std::int64_t cell = trace.samples.back().cell;
    if (cell < 0) return 0;
    std::size_t policy = problem_.policies.size() - 1;
    while (policy > 0 && (is_through(policy, trace) || !chooser_.holds(policy, cell))) --policy;
    return policy;
  }

  [[nodiscard]] std::int32_t begin_countdown(const RunTrace& trace) const {
    const AnswerPolicy& policy = problem_.policies[policy_];
    const RunTrace::Sample& sample = trace.samples.back();
    if (policy_ == 0) return reset(sample.delay);
    return reset(problem_.values.at(policy.delay)[at(sample.cell)]);
  }

  [[nodiscard]] std::int32_t reset(std::int32_t delay) const {
    return delay < 0 ? 0 : countdown_from(delay, problem_.connection_delay);
  }

  /// Whether the last step was one of P, as far as arrival says.
  [[nodiscard]] bool is_step_of_aim(const RunTrace& trace) const {
    const std::int32_t before = trace.samples[trace.samples.size() - 2].arrival;
    const std::int32_t after = trace.samples.back().arrival;
    if (problem_.spec->goal_then == GoalThen::stay) return after <= before;
    return before == 0 ? after != kUnbounded && after >= 0 : after < before;
  }

  LoopProblem problem_;
  ActionChooser chooser_;
  std::size_t policy_ = 0;
  std::int32_t countdown_ = 0;
  std::int64_t promised_ = kUnbounded;  ///< steps to the aim
  bool is_aimed_ = false;               ///< the step is one towards an aim that lasts
};

/// Agents on a network that loses steps: each mode says who is connected.
class OnNetwork final : public Schedule {
 public:
  OnNetwork(const LoopProblem& problem, Policy policy, PointDynamics& dynamics, KeptInputs& controller)
      : spec_(*problem.spec), network_(*problem.network) {
    std::map<std::string, std::shared_ptr<ActionChooser>> known;
    for (std::size_t mode = 0; mode < network_.modes().size(); ++mode) {
      const bool is_safest = network_.modes()[mode].is_connected && !problem.mode_values.empty();
      std::shared_ptr<ActionChooser>& chooser =
          known[network_.modes()[mode].partition->canonical + (is_safest ? " " + std::to_string(mode) : "")];
      if (!chooser) {
        const LoopProblem mode_problem = problem_of(problem, mode, is_safest);
        chooser = std::make_shared<ActionChooser>(mode_problem, policy, dynamics, controller);
      }
      choosers_.push_back(chooser);
    }
  }

  std::int32_t begin(const RunTrace& /*trace*/, RandomStream losses) override {
    losses_ = losses;
    mode_ = spec_.risk ? spec_.risk->start : 0;
    if (spec_.risk && spec_.risk->is_drawn) mode_ = network_.draw(mode_, *losses_);
    return countdown();
  }
  std::int32_t arrive(const RunTrace& /*trace*/) override {
    mode_ = network_.draw(mode_, *losses_);
    return countdown();
  }
  Turn turn(const RunTrace& /*trace*/) override { return {*choosers_[mode_], {.countdown = countdown()}}; }

  [[nodiscard]] Outcome stopped(const RunTrace& trace, bool is_forbidden) const override {
    const bool has_rule = !network_.modes()[mode_].is_connected && spec_.silence;
    return has_rule && !is_forbidden ? Outcome::stuck : Schedule::stopped(trace, is_forbidden);
  }

 private:
  [[nodiscard]] std::int32_t countdown() const { return network_.modes()[mode_].is_connected ? 0 : 1; }

  [[nodiscard]] LoopProblem problem_of(const LoopProblem& problem, std::size_t mode, bool is_safest) const {
    LoopProblem mode_problem = problem;
    const std::string delay = problem.policies.front().delay;
    mode_problem.partition = network_.modes()[mode].partition;
    mode_problem.policies.resize(1);
    if (is_safest) {
      mode_problem.policies.front() = safest_policy(delay);
      for (const auto& [path, cells] : problem.mode_values[mode]) mode_problem.values[path] = cells;
    }
    if (!network_.modes()[mode].is_connected && spec_.silence) {
      mode_problem.policies = silence_policies(spec_);
      mode_problem.policies.front().delay = delay;
    }
    return mode_problem;
  }

  const ProblemSpec& spec_;
  const LossyNetwork& network_;
  std::vector<std::shared_ptr<ActionChooser>> choosers_;  ///< [mode]
  std::optional<RandomStream> losses_;
  std::size_t mode_ = 0;
};

/// Agents who follow the rule of silence while they are silent, and then the last policy.
class RuleFollowing final : public Schedule {
 public:
  RuleFollowing(const LoopProblem& problem, Policy policy, std::int64_t silent_steps, PointDynamics& dynamics,
                KeptInputs& controller)
      : rule_(problem.policies.size() - 1),
        has_then_(problem.policies.back().make_then != nullptr),
        steps_(problem.start_steps()),
        silent_steps_(silent_steps),
        chooser_(problem, policy, dynamics, controller) {}

  std::int32_t begin(const RunTrace& trace, RandomStream /*losses*/) override {
    promised_ = steps_[at(trace.samples.front().cell)];
    return arrive(trace);
  }
  std::int32_t arrive(const RunTrace& trace) override {
    if (silent_steps_ == kUnbounded) return kUnbounded;
    return static_cast<std::int32_t>(std::max<std::int64_t>(0, silent_steps_ - std::ssize(trace.steps)));
  }
  Turn turn(const RunTrace& trace) override {
    const bool is_after = std::ssize(trace.steps) >= silent_steps_;
    if (is_after && !has_then_) return {chooser_, {}};
    return {chooser_, {.policy = rule_, .countdown = 1, .is_after_silence = is_after}};
  }

  [[nodiscard]] Outcome stopped(const RunTrace& trace, bool /*is_forbidden*/) const override {
    return is_promised(std::ssize(trace.samples)) ? Outcome::broke_promise : Outcome::stuck;
  }

  [[nodiscard]] std::optional<Outcome> fault(const RunTrace& trace) const override {
    if (trace.samples.back().delay != kOutsideSafe) return std::nullopt;
    return is_promised(std::ssize(trace.steps)) ? Outcome::broke_promise : Outcome::left_safe_set;
  }

 private:
  /// Whether the promise is about a sample.
  [[nodiscard]] bool is_promised(std::int64_t sample) const {
    return promised_ == kUnbounded || silent_steps_ <= promised_ || sample <= promised_;
  }

  std::size_t rule_;
  bool has_then_;
  std::span<const std::int32_t> steps_;
  std::int64_t silent_steps_;
  ActionChooser chooser_;
  std::int64_t promised_ = 0;
};

}  // namespace

std::unique_ptr<Schedule> make_schedule(const LoopProblem& problem, Policy policy, std::int64_t silent_steps,
                                        PointDynamics& dynamics, KeptInputs& controller) {
  if (problem.network != nullptr) return std::make_unique<OnNetwork>(problem, policy, dynamics, controller);
  if (problem.policies.back().is_anywhere)
    return std::make_unique<RuleFollowing>(problem, policy, silent_steps, dynamics, controller);
  return std::make_unique<SelfTriggered>(problem, policy, dynamics, controller);
}

}  // namespace coordreq
