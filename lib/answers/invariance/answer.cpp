#include "answers/invariance/answer.hpp"

#include <nlohmann/json.hpp>
#include <optional>

#include "answers/checking/all_checks.hpp"
#include "answers/invariance/safe_set.hpp"
#include "answers/kept_levels.hpp"
#include "answers/work_json.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

void find_invariance_set(Answers& answers, const StageWork& work) {
  const AnalysisContext& context = answers.context;
  const Synthesis synthesis = context.spec.controller.synthesis;
  Invariance& result = answers.add(Invariance{});
  // No level is greater than if cells were lost one by one.
  const LevelBounds bounds{&context.safe, context.engine->grid().points() + 1};
  const std::optional<RowSymmetry> symmetry = context.symmetry(single_classes(context.abstraction->inputs));
  find_or_take_levels(work, *context.engine, bounds, result.collision_time, [&](const WaveWatch& watch) {
    return find_collision_times(*context.engine, *context.hull, context.safe, synthesis, watch, work.team,
                                result.counts, context.equal(symmetry ? &*symmetry : nullptr),
                                context.terminal_or_null());
  });
  follow_from_collision_times(result, work.team);
  const Controller& controller =
      answers.add(Controller{&*context.engine, &result.invariant, &result.collision_time, synthesis});
  NonterminalController& nonterminal = answers.add(NonterminalController{{}, controller});
  if (!context.terminal) return;
  nonterminal.cells = subset_of(result.invariant, *context.terminal, false, context.shared_rows());
  nonterminal.controller.invariant = &nonterminal.cells;
  nonterminal.controller.whole = &result.invariant;
}

/// Adds Invariance, with the Controller of its K, and NonterminalController: "invariance".
std::vector<Stage> invariance_stages(const ProblemSpec& /*spec*/) {
  return {{"invariance", find_invariance_set}};
}

void summarise_invariance(const Answers& answers, Json& summary, Json& work) {
  const auto& invariance = answers.get<Invariance>();
  summary["invariant"] = invariance.cells;
  summary["iterations"] = invariance.iterations;
  summary["guarantee"] = guarantee_of(answers.context.spec);
  work["invariance"] = work_json(invariance.counts);
}

void describe_invariance(const ProblemSpec& /*spec*/, const FieldSource& source, Json& info) {
  info["safe"] = source.counted("/safe").front();
  info["invariant"] = source.counted("/invariant").front();
}

MemoryNeed invariance_memory(const EngineSizes& sizes, int threads) {
  const InputSpace& inputs = sizes.model().inputs();
  const double sets = sizes.model().spec().ends_at_goal() ? 2 : 1;  // K, and K \ G
  MemoryNeed need{.kept = sizes.levels() + sets * sizes.set(),
                  .work = sizes.groups(single_classes(inputs)) + sizes.wave(threads),
                  .array = sizes.cells() * sizeof(std::int16_t)};
  if (!sizes.model().spec().output.controller) return need;
  need.written = sizes.groups({whole_class(inputs)}) + sizes.readers(threads);
  need.array = std::max(need.array, sizes.packed_pairs(inputs.count()));
  return need;
}

}  // namespace

std::string guarantee_of(const ProblemSpec& spec) {
  if (spec.abstraction.safe == Membership::center) return "samples-center";
  return spec.abstraction.between_samples ? "continuous" : "samples";
}

const Answer invariance_answer = {.stages = invariance_stages,
                                  .memory = invariance_memory,
                                  .fields = invariance_fields,
                                  .fill = fill_invariance_fields,
                                  .summarise = summarise_invariance,
                                  .describe = describe_invariance,
                                  .check = check_invariance};

}  // namespace coordreq
