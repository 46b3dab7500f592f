#include "answers/goal/answer.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "answers/checking/all_checks.hpp"
#include "answers/countdown/fields.hpp"
#include "answers/countdown/leaving_cells.hpp"
#include "answers/countdown/stage.hpp"
#include "answers/goal/approach_layers.hpp"
#include "answers/goal/arrival.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/invariance/safe_set.hpp"
#include "answers/kept_levels.hpp"
#include "answers/layers/answer.hpp"
#include "answers/work_json.hpp"
#include "base/grouped.hpp"
#include "choices/projection_bytes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// What follows arrival, unless it is what a goal alone means.
void add_then(const ProblemSpec& spec, const LongestReturns& returns, Json& goal) {
  if (spec.goal_then == GoalThen::safe) return;
  goal["then"] = goal_then_name(spec.goal_then);
  if (spec.goal_then != GoalThen::come_back) return;
  goal["longest_return"] = returns.forced ? Json(*returns.forced) : Json();
  goal["longest_gap"] = returns.any_choice ? Json(*returns.any_choice) : Json();
}

void find_arrival(Answers& answers, const StageWork& work) {
  const AnalysisContext& context = answers.context;
  const auto& controller = answers.get<Controller>();
  Goal& goal = answers.add(Goal{});
  goal.engine = std::make_unique<ProgressEngine>(context);
  const RowShare* const share = context.shared_rows();
  const CellSet safe =
      context.terminal
          ? *context.terminal
          : subset_of(cells_that_satisfy(*context.spec.goal, context.spec, context.abstraction->grid,
                                         context.abstraction->inputs, work.team, share),
                      context.safe, true, share);
  goal.cells = subset_of(safe, *controller.invariant, true, share);
  const RowEngine& engine = goal.engine->engine();
  const LevelBounds bounds{controller.invariant, INT64_MAX};
  const GoalThen then = context.spec.goal_then;
  const LastingProblem lasting{goal.engine.get(), controller.invariant, &goal.cells, controller.synthesis};
  find_or_take_levels(work, engine, bounds, goal.nearness, [&](const WaveWatch& watch) {
    if (then == GoalThen::stay) return find_stay_nearness(lasting, watch, work.team, goal.counts);
    if (then == GoalThen::come_back) return find_return_nearness(lasting, watch, work.team, goal.counts);
    return find_nearness(engine, goal.engine->hull(), *controller.invariant, goal.cells, controller.synthesis,
                         watch, work.team, goal.counts, goal.engine->equal_work());
  });
  goal.winning = winning_cells(goal.nearness, work.team);
  goal.longest = longest_arrival(goal.nearness, work.team);
  goal.sizes = {context.count(goal.cells, &work.team), context.count(goal.winning, &work.team),
                context.count(safe, &work.team)};
  if (context.spec.is_goal_lasting()) {
    goal.outside_goal = goal.winning;
    goal.bounds = progress_bounds(lasting, goal.nearness, then);
  } else {
    goal.outside_goal = subset_of(goal.winning, goal.cells, false, share);
  }
  if (then == GoalThen::come_back) goal.returns = find_longest_returns(lasting, goal.nearness, work.team);
  goal.progress = Controller{.engine = &engine,
                             .invariant = &goal.outside_goal,
                             .levels = &goal.nearness,
                             .synthesis = controller.synthesis,
                             .approaches = true,
                             .bounds = context.spec.is_goal_lasting() ? &goal.bounds : nullptr};
  goal.approach.resize(context.spec.coordination.partitions.size());
}

void find_approach(std::size_t p, Answers& answers, const StageWork& work) {
  const ProblemSpec& spec = answers.context.spec;
  Goal& goal = answers.get<Goal>();
  const RowEngine& engine = goal.engine->engine();
  const DelayLayers& layers = answers.get<PartitionLayers>().partitions[p];
  const bool is_lasting = spec.is_goal_lasting();
  const ApproachSets sets{.progress = goal.engine.get(),
                          .nearness = &goal.nearness,
                          .goal = is_lasting ? nullptr : &goal.cells,
                          .outside_goal = &goal.outside_goal,
                          .bounds = goal.progress.bounds};
  const auto find = [&](const WaveWatch& watch, WaveCounts& counts) {
    work.enter_substage("projections");
    const PartitionSpec& partition = spec.coordination.partitions[p];
    const ActionGrouping grouping(engine, input_classes(spec, answers.context.abstraction->inputs, partition),
                                  work.team);
    const Projections projections(goal.progress, grouping, work.team);
    work.enter_substage("");
    return find_approach_levels(sets, projections, layers, spec.coordination.max_delay, watch, work.team,
                                counts);
  };
  find_layers(answers.context, engine, goal.winning, work, goal.approach[p], find,
              is_lasting ? nullptr : &layers);
}

/// Adds Goal, if the spec has one: "arrival", then "approach PARTITION" for each partition.
std::vector<Stage> goal_stages(const ProblemSpec& spec) {
  if (!spec.goal) return {};
  std::vector<Stage> stages = {{"arrival", find_arrival}};
  for (std::size_t p = 0; p < spec.coordination.partitions.size(); ++p)
    stages.push_back({"approach " + spec.coordination.partitions[p].name,
                      [p](Answers& answers, const StageWork& work) { find_approach(p, answers, work); }});
  return stages;
}

void summarise_goal(const Answers& answers, Json& summary, Json& work) {
  const Goal* const goal = answers.find<Goal>();
  if (goal == nullptr) return;
  summary["goal"] = {{"cells", goal->sizes.cells},
                     {"winning", goal->sizes.winning},
                     {"longest_arrival", goal->longest ? Json(*goal->longest) : Json()}};
  add_then(answers.context.spec, goal->returns, summary["goal"]);
  work["arrival"] = work_json(goal->counts);
  for (std::size_t p = 0; p < goal->approach.size(); ++p) {
    summary["partitions"][p]["approach"] = layers_json(answers.context, goal->approach[p]);
    work["approach " + answers.context.spec.coordination.partitions[p].name] =
        work_json(goal->approach[p].counts);
  }
}

void describe_goal(const ProblemSpec& spec, const FieldSource& source, Json& info) {
  if (!spec.goal) return;
  const std::int64_t longest = source.attribute("/arrival", "longest_arrival");
  info["goal"] = {{"cells", source.attribute("/arrival", "goal_cells")},
                  {"winning", source.attribute("/arrival", "winning_cells")},
                  {"longest_arrival", longest < 0 ? Json() : Json(longest)}};
  LongestReturns returns;
  if (spec.goal_then == GoalThen::come_back) {
    const auto steps = [&](const char* name) -> std::optional<std::int32_t> {
      const std::int64_t value = source.attribute("/arrival", name);
      return value < 0 ? std::nullopt : std::optional(static_cast<std::int32_t>(value));
    };
    returns = {steps("longest_return"), steps("longest_gap")};
  }
  add_then(spec, returns, info["goal"]);
}

/// Warns of a goal at which no cell arrives, or none but its own.
Warnings advise_on_goal(const Answers& answers) {
  const Goal* const goal = answers.find<Goal>();
  if (goal == nullptr || answers.context.safe_cells == 0) return {};
  const GoalThen then = answers.context.spec.goal_then;
  if (goal->sizes.winning == 0 && goal->sizes.cells > 0)  // of a lasting goal alone
    return {{"goal", "/goal",
             fmt::format("from no cell can the goal be {}: it cannot be forced",
                         then == GoalThen::stay ? "kept in the end" : "visited again and again")}};
  if (goal->sizes.winning == 0) {
    const std::string hint =
        goal->sizes.safe == 0
            ? ""
            : fmt::format("; of the safe set {}: if the task ends there, say \"then\": \"over\"",
                          goal->sizes.safe == 1 ? "one is" : grouped(goal->sizes.safe) + " are");
    return {{"goal", "/goal",
             fmt::format("no cell of the {} set is in the goal on this grid: it cannot be forced{}",
                         answers.context.terminal ? "safe" : "invariance", hint)}};
  }
  if (goal->longest.value_or(0) > 0) return {};
  const bool is_closed = answers.context.spec.abstraction.cells == Cells::closed;
  return {{"goal", "/goal",
           std::string("the goal can be forced from goal cells only") +
               (is_closed
                    ? "; with closed cells a motion of at most one cell a step still meets the cell where it "
                      "began: try smaller steps, a longer period or \"cells\": \"half_open\""
                    : "")}};
}

MemoryNeed goal_memory(const EngineSizes& sizes, int threads) {
  const ProblemSpec& spec = sizes.model().spec();
  if (!spec.goal) return {};
  const auto partitions = static_cast<double>(spec.coordination.partitions.size());
  MemoryNeed need{
      .kept = (partitions + (spec.is_goal_lasting() ? 2 : 1)) * sizes.levels() + 3 * sizes.set(),
      .work = sizes.groups(single_classes(sizes.model().inputs())) + sizes.condition_of_held(*spec.goal),
      .array = partitions * sizes.cells() * sizeof(std::int16_t)};
  if (has_safe_side(spec)) {
    const double families = spec.abstraction.between_samples ? 2 : 1;  // of tables: of posts, and of tubes
    need.kept += sizes.hull();
    for (std::size_t t = 0; t < spec.states.size(); ++t)
      need.kept += families * (sizes.table(t) + sizes.slices(t));
  }
  for (const PartitionSpec& partition : spec.coordination.partitions) {
    const std::vector<InputClass> classes = input_classes(spec, sizes.model().inputs(), partition);
    need.work = std::max(need.work, sizes.groups(classes) + projection_bytes(sizes, classes));
  }
  need.work += sizes.wave(threads) + sizes.set();
  if (spec.output.actions || spec.output.controller)
    need.written +=
        sizes.groups({whole_class(sizes.model().inputs())}) + 2 * sizes.readers(threads) + sizes.set();
  return need;
}

}  // namespace

std::unique_ptr<const PiecewiseController> piecewise_controller(const Answers& answers,
                                                                bool is_in_goal_only) {
  auto result = std::make_unique<PiecewiseController>();
  Controller everywhere = answers.get<Controller>();
  const Goal* const goal = answers.find<Goal>();
  if (goal == nullptr) {
    result->pieces.push_back({everywhere, &*answers.context.hull});
    return result;
  }
  // In cells where the task is over no convention is needed.
  const CellSet& nonterminal = *answers.get<NonterminalController>().controller.invariant;
  const bool is_lasting = answers.context.spec.is_goal_lasting();
  result->rest = is_in_goal_only && is_lasting ? CellSet(goal->cells.rows(), goal->cells.row_length())
                 : is_in_goal_only
                     ? goal->cells
                     : subset_of(nonterminal, goal->outside_goal, false, answers.context.shared_rows());
  everywhere.whole = everywhere.invariant;
  everywhere.invariant = &result->rest;
  result->pieces.push_back({everywhere, &*answers.context.hull});
  result->pieces.push_back({goal->progress, &goal->engine->hull()});
  return result;
}

const Answer goal_answer = {.stages = goal_stages,
                            .memory = goal_memory,
                            .fields = goal_fields,
                            .fill = fill_goal_fields,
                            .summarise = summarise_goal,
                            .describe = describe_goal,
                            .advise = advise_on_goal,
                            .policies = goal_policies,
                            .check = check_goal};

}  // namespace coordreq
