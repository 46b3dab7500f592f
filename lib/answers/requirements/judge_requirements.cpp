#include "answers/requirements/judge_requirements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "answers/blind/answer.hpp"
#include "answers/goal/answer.hpp"
#include "answers/goal/showing_order.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/layers/answer.hpp"
#include "answers/requirements/escape_result.hpp"
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
    asked_ = ask(requirement);
    const UniformGrid& grid = context_.abstraction->grid;
    const CellSet region = cells_of_region(requirement.where, grid, team_, context_.shared_rows());
    const CellVerdict verdict = judge_cells(region, grid, asked_, number_stride_, team_);
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
    if (requirement.kind == RequirementKind::max_risk) {
      EscapePath alone;
      alone.cells = {cell};
      alone.end = EscapeEnd::too_risky;
      return result_of(alone, context_, asked_, number_stride_);
    }
    EscapeSets sets{.context = &context_,
                    .invariance = &answers_.get<Invariance>(),
                    .kind = requirement.kind,
                    .number_stride = number_stride_};
    if (is_of_goal(requirement)) sets.goal = answers_.find<Goal>();
    if (showing_order_) sets.showing_order = &*showing_order_;
    if (requirement.partition) {
      const auto p = static_cast<std::size_t>(*requirement.partition);
      sets.classes = input_classes(context_.spec, context_.abstraction->inputs,
                                   context_.spec.coordination.partitions[p]);
      sets.layers_of = &answers_.get<PartitionLayers>().partitions[p].layers_of;
      sets.approach_of = &asked_.layers->layers_of;
      if (requirement.kind == RequirementKind::min_silence) {
        sets.partition = &context_.spec.coordination.partitions[p];
        sets.silence_of = &asked_.layers->layers_of;
        if (context_.spec.silence->has_then()) sets.lost = &answers_.get<Silence>().lost;
      }
      if (requirement.kind == RequirementKind::min_blind_delay) {
        sets.blind_delay_of = &asked_.layers->layers_of;
        sets.blind_countdown_of = &blind_layers(answers_, p).layers_of;
      }
    }
    ResultPath path = result_of(find_escape(sets, cell), context_, asked_, number_stride_);
    if (is_followed(requirement.kind, path)) path.seen = follow_escape(sets, cell);
    return path;
  }

  const Answers& answers_;
  const AnalysisContext& context_;
  const Controller& controller_;
  ThreadTeam& team_;
  UniformGrid grid_;                         ///< the spec's
  CellRequirement asked_;                    ///< the requirement being judged
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
