#include "answers/requirements/judge_requirements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "answers/blind/answer.hpp"
#include "answers/counterexample/counterexample.hpp"
#include "answers/goal/answer.hpp"
#include "answers/goal/arrival.hpp"
#include "answers/goal/showing_order.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/layers/answer.hpp"
#include "answers/requirements/requirement.hpp"
#include "answers/requirements/risk_limit.hpp"
#include "answers/risk/answer.hpp"
#include "answers/silence/answer.hpp"
#include "answers/step_codes.hpp"
#include "base/error.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Judges one requirement after the other.
class Judge {
 public:
  Judge(const Answers& answers, ThreadTeam& team)
      : answers_(answers),
        context_(answers.context),
        controller_(answers.get<Controller>()),
        team_(team),
        grid_(make_grid(context_.spec)) {
    const UniformGrid& engine_grid = context_.abstraction->grid;
    for (std::size_t d = 0; d < engine_grid.size(); ++d)
      number_stride_.push_back(grid_.stride(engine_grid.state(d)));
  }

  ResultRequirement judge(std::size_t r) {
    const RequirementSpec& requirement = context_.spec.requirements[r];
    judged_ = ask(requirement);
    const UniformGrid& grid = context_.abstraction->grid;
    const CellSet region = cells_of_region(requirement.where, grid, team_, context_.shared_rows());
    const CellVerdict verdict = judge_cells(region, grid, judged_, number_stride_, team_);
    ResultRequirement result{.name = requirement.name,
                             .cells = static_cast<std::uint64_t>(verdict.cells),
                             .failing = static_cast<std::uint64_t>(verdict.failing),
                             .least_delay = verdict.worst_value};
    if (const std::optional<DomainSide> side = side_reached(requirement.where, grid_)) {
      result.reached_side = {.state = side->dimension, .above = side->above};
    }
    result.is_risk = requirement.kind == RequirementKind::max_risk;
    if (result.is_risk)
      result.risk = compared_risk(requirement, verdict.worst_value, answers_.get<RiskAnswer>().risk.rate);
    result.holds = verdict.failing == 0 && !result.reached_side;
    if (verdict.worst) {
      if (needs_showing_order(requirement, verdict.worst_value)) find_showing_order_once();
      result.path = path_from(*verdict.worst, requirement);
    }
    return result;
  }

 private:
  [[nodiscard]] static bool is_of_goal(const RequirementSpec& requirement) {
    return requirement.kind == RequirementKind::max_arrival ||
           requirement.kind == RequirementKind::min_approach_delay;
  }

  /// Whether the path from a cell of this value asks which worst cell comes first.
  [[nodiscard]] bool needs_showing_order(const RequirementSpec& requirement, std::int32_t value) const {
    if (!context_.spec.is_goal_lasting()) return false;
    if (requirement.kind == RequirementKind::min_approach_delay) return value == kOutsideWinning;
    if (requirement.kind != RequirementKind::max_arrival || value < 0) return false;
    return context_.spec.goal_then == GoalThen::stay || value == kUnbounded;
  }

  void find_showing_order_once() {
    if (showing_order_) return;
    const Goal& goal = answers_.get<Goal>();
    const LastingProblem problem{goal.engine.get(), controller_.invariant, &goal.cells,
                                 controller_.synthesis};
    showing_order_ = find_showing_order(problem, goal.nearness, context_.spec.goal_then, team_);
  }

  [[nodiscard]] CellRequirement ask(const RequirementSpec& requirement) const {
    CellRequirement result{.collision_time = controller_.levels,
                           .kind = requirement.kind,
                           .layers = nullptr,
                           .nearness = nullptr,
                           .steps = requirement.steps};
    const Goal* const goal = answers_.find<Goal>();
    if (goal != nullptr) result.nearness = &goal->nearness;
    if (requirement.kind == RequirementKind::max_risk) {
      const RiskAnswer& risk = answers_.get<RiskAnswer>();
      result.risks = &risk.start(*context_.spec.risk);
      result.steps = greatest_risk_bits(requirement, risk.risk.rate);
    }
    if (!requirement.partition) return result;
    const auto p = static_cast<std::size_t>(*requirement.partition);
    result.layers = requirement.kind == RequirementKind::min_approach_delay ? &goal->approach[p]
                    : requirement.kind == RequirementKind::min_blind_delay  ? &blind_delays(answers_, p)
                    : requirement.kind == RequirementKind::min_silence
                        ? &silence_of(answers_, p).layers
                        : &answers_.get<PartitionLayers>().partitions[p];
    return result;
  }

  [[nodiscard]] ResultPath path_from(std::int64_t cell, const RequirementSpec& requirement) const {
    CounterexampleProblem problem{.context = &context_,
                                  .invariant = is_in(answers_.get<Invariance>().invariant),
                                  .collision_time = steps_from(*controller_.levels),
                                  .value = [this](std::int64_t x) { return judged_.value_of(x); },
                                  .number_stride = number_stride_};
    if (requirement.partition) {
      const auto p = static_cast<std::size_t>(*requirement.partition);
      problem.partition = &context_.spec.coordination.partitions[p];
    }
    if (requirement.kind == RequirementKind::min_silence) {
      problem.inside = silent_phase(steps_from(judged_.layers->layers_of), nullptr).holds;
    } else if (is_followed(requirement.kind)) {
      problem.inside = problem.invariant;
    }
    if (is_of_goal(requirement)) {
      problem.arrival = [this, is_invariant = problem.invariant](std::int64_t y) {
        return is_invariant(y) ? arrival_at(*judged_.nearness, y) : -1;
      };
      if (showing_order_) problem.showing_order = steps_from(*showing_order_);
    }
    problem.phases = phases(requirement, problem);
    ResultPath path = find_counterexample(problem, cell);
    if (requirement.kind == RequirementKind::max_risk) path.end = PathEnd::too_risky;
    return path;
  }

  /// How agents choose on a path. The same in all processes, of which each knows the sets in its rows alone.
  [[nodiscard]] std::vector<CounterexamplePhase> phases(const RequirementSpec& requirement,
                                                        const CounterexampleProblem& problem) const {
    const CounterexamplePhase evasive = evasive_phase(problem);
    switch (requirement.kind) {
      case RequirementKind::max_risk:
        return {};
      case RequirementKind::min_silence:
        return silent_phases(problem);
      case RequirementKind::min_blind_delay:
        return {blind_phase(requirement, problem), evasive};
      case RequirementKind::max_arrival:
        return {together(problem.invariant), evasive};
      case RequirementKind::min_approach_delay:
        return approach_phases(requirement, problem);
      default:
        if (!requirement.partition) return {evasive};
        return {independent_phase(problem, steps_from(judged_.layers->layers_of)), evasive};
    }
  }

  [[nodiscard]] static CounterexamplePhase together(IsCell holds) {
    return {.choices = PathPhase::together, .holds = std::move(holds), .steps = {}};
  }

  [[nodiscard]] std::vector<CounterexamplePhase> silent_phases(const CounterexampleProblem& problem) const {
    const StepsFrom silence = steps_from(judged_.layers->layers_of);
    if (!context_.spec.silence->has_then())
      return {silent_phase(silence, problem.collision_time), evasive_phase(problem)};
    const StepsFrom lost = steps_from(answers_.get<Silence>().lost);
    return {silent_phase(silence, lost),
            {.choices = PathPhase::afterwards, .holds = evasive_phase(problem).holds, .steps = lost}};
  }

  [[nodiscard]] CounterexamplePhase blind_phase(const RequirementSpec& requirement,
                                                const CounterexampleProblem& problem) const {
    const auto p = static_cast<std::size_t>(*requirement.partition);
    const StepsFrom countdown = steps_from(blind_layers(answers_, p).layers_of);
    const StepsFrom seen = steps_from(answers_.get<PartitionLayers>().partitions[p].layers_of);
    CounterexamplePhase phase = independent_phase(problem, countdown);
    phase.first = steps_from(judged_.layers->layers_of);
    phase.has_no_action = [countdown, seen](std::int64_t x) { return countdown(x) == 1 && seen(x) > 1; };
    return phase;
  }

  [[nodiscard]] std::vector<CounterexamplePhase> approach_phases(const RequirementSpec& requirement,
                                                                 const CounterexampleProblem& problem) const {
    const auto p = static_cast<std::size_t>(*requirement.partition);
    const StepsFrom delay = steps_from(answers_.get<PartitionLayers>().partitions[p].layers_of);
    const Goal& goal = answers_.get<Goal>();
    return {together([is_invariant = problem.invariant, &winning = goal.winning](std::int64_t x) {
              return is_invariant(x) && !winning.test(x);
            }),
            {.choices = PathPhase::approaching,
             .holds = is_in(goal.outside_goal),
             .steps = steps_from(judged_.layers->layers_of)},
            independent_phase(problem, delay),
            evasive_phase(problem)};
  }

  const Answers& answers_;
  const AnalysisContext& context_;
  const Controller& controller_;
  ThreadTeam& team_;
  UniformGrid grid_;                         ///< the spec's
  CellRequirement judged_;                   ///< the requirement being judged
  std::optional<LevelMap> showing_order_;    ///< of a lasting goal, once a path needs it
  std::vector<std::int64_t> number_stride_;  ///< [dimension of the engine]
};

}  // namespace

void check_regions(const ProblemSpec& spec, ThreadTeam& team) {
  const UniformGrid grid = make_grid(spec);
  for (std::size_t r = 0; r < spec.requirements.size(); ++r) {
    if (cells_of_region(spec.requirements[r].where, grid, team).count() > 0) continue;
    throw SpecError("expected a region that meets the grid, found one that meets no cell",
                    fmt::format("/requirements/{}/where", r));
  }
}

std::vector<ResultRequirement> judge_requirements(const Answers& answers, ThreadTeam& team) {
  Judge judge(answers, team);
  std::vector<ResultRequirement> result;
  for (std::size_t r = 0; r < answers.context.spec.requirements.size(); ++r) result.push_back(judge.judge(r));
  return result;
}

}  // namespace coordreq
