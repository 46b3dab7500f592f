#include "answers/silence/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "answers/checking/all_checks.hpp"
#include "answers/countdown/fields.hpp"
#include "answers/countdown/stage.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/invariance/safe_set.hpp"
#include "answers/kept_levels.hpp"
#include "answers/layers/answer.hpp"
#include "answers/paths.hpp"
#include "answers/silence/silent_actions.hpp"
#include "answers/work_json.hpp"
#include "base/grouped.hpp"
#include "choices/projection_bytes.hpp"
#include "spec/problem_spec.hpp"
#include "spec/silence.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

std::size_t count_of_answers(const ProblemSpec& spec) {
  return all_have_rules(*spec.silence) ? 1 : spec.coordination.partitions.size();
}

Silence& silence_in(Answers& answers) {
  if (answers.find<Silence>() == nullptr)
    answers.add(Silence{.partitions = std::vector<SilencePartition>(count_of_answers(answers.context.spec))});
  return answers.get<Silence>();
}

/// The nonterminal cells of a set: all but those of a goal that ends it. @param subset storage
/// for them
const CellSet& nonterminal_cells(const AnalysisContext& context, const CellSet& set, CellSet& subset) {
  if (!context.terminal) return set;
  subset = subset_of(set, *context.terminal, false, context.shared_rows());
  return subset;
}

/// Finds K' = lim SPRE_S^i(X) for the product of the actions that `then` leaves to each agent: by the
/// operator of the layers, from S on, without a limit.
void find_set(Answers& answers, const StageWork& work) {
  const AnalysisContext& context = answers.context;
  Silence& silence = silence_in(answers);
  const LevelBounds bounds{&context.safe, context.engine->grid().points() + 1};
  find_or_take_levels(work, *context.engine, bounds, silence.lost, [&](const WaveWatch& watch) {
    work.enter_substage("projections");
    CellSet subset;
    const SilentActions actions(answers, {context.spec.silence->then, "then"}, agents_alone(context.spec),
                                nonterminal_cells(context, context.safe, subset), work.team);
    work.enter_substage("");
    return find_layer_levels(*context.engine, *context.hull, context.safe, actions.projections, {},
                             std::nullopt, watch, work.team, silence.counts, context.terminal_or_null());
  });
  silence.set = silence.lost.top_cells(work.team);
  silence.cells = context.count(silence.set, &work.team);
}

std::vector<std::int64_t> sums(const AnalysisContext& context, const SilentActions& actions) {
  std::vector<std::int64_t> result;
  for (const std::atomic<std::int64_t>& count : actions.without_action)
    result.push_back(sum_of_all(context.shared_rows(), count));
  return result;
}

/// Finds the silence of a partition. If all agents have rules it is the same for every partition, and found
/// with each agent by itself.
void find_silence(std::size_t p, Answers& answers, const StageWork& work) {
  const AnalysisContext& context = answers.context;
  const ProblemSpec& spec = context.spec;
  const CoordinationSpec& coordination = spec.coordination;
  SilencePartition& partition = silence_in(answers).partitions[p];
  const CellSet& set = silence_set(answers);
  CellSet subset;
  const CellSet& cells = nonterminal_cells(context, set, subset);
  const auto classes =
      all_have_rules(*spec.silence) ? agents_alone(spec) : coordination.partitions[p].classes;
  const AgentRules rules{spec.silence->actions, "actions"};
  const auto find = [&](const WaveWatch& watch, WaveCounts& counts) {
    work.enter_substage("projections");
    const SilentActions actions(answers, rules, classes, cells, work.team);
    work.enter_substage("");
    partition.without_action = sums(context, actions);
    return find_layer_levels(*context.engine, *context.hull, set, actions.projections, {},
                             coordination.max_delay, watch, work.team, counts, context.terminal_or_null());
  };
  find_layers(context, *context.engine, set, work, partition.layers, find);
  // Kept levels do not have these counts.
  if (partition.without_action.empty())
    partition.without_action = sums(context, SilentActions(answers, rules, classes, cells, work.team));
}

std::string stage_name(const ProblemSpec& spec, std::size_t p) {
  return all_have_rules(*spec.silence) ? "silence" : "silence " + spec.coordination.partitions[p].name;
}

/// Adds Silence, if the spec says what silent agents do: "silence set" if there is `then`, then "silence" or,
/// if silence depends on the partition, "silence PARTITION" for each.
std::vector<Stage> silence_stages(const ProblemSpec& spec) {
  if (!spec.silence) return {};
  std::vector<Stage> stages;
  if (spec.silence->has_then()) stages.push_back({"silence set", find_set});
  for (std::size_t p = 0; p < count_of_answers(spec); ++p)
    stages.push_back({stage_name(spec, p),
                      [p](Answers& answers, const StageWork& work) { find_silence(p, answers, work); }});
  return stages;
}

void summarise_silence(const Answers& answers, Json& summary, Json& work) {
  const auto* const silence = answers.find<Silence>();
  if (silence == nullptr) return;
  const ProblemSpec& spec = answers.context.spec;
  if (spec.silence->has_then()) {
    summary["silence_set"] = silence->cells;
    work["silence set"] = work_json(silence->counts);
  }
  for (std::size_t p = 0; p < spec.coordination.partitions.size(); ++p) {
    const DelayLayers& layers = silence_of(answers, p).layers;
    summary["partitions"][p]["silence"] = layers_json(answers.context, layers);
    work[stage_name(spec, p)] = work_json(layers.counts);
  }
}

/// Fails if an F is no layer.
void describe_silence(const ProblemSpec& spec, const FieldSource& source, Json& info) {
  if (!spec.silence) return;
  if (spec.silence->has_then()) info["silence_set"] = source.counted(paths::kSilenceSet).front();
  describe_layers(spec, source, kSilenceKind, info);
}

/// Warns of cells in which silent agents have no action.
Warnings advise_on_silence(const Answers& answers) {
  const auto* const silence = answers.find<Silence>();
  if (silence == nullptr) return {};
  const ProblemSpec& spec = answers.context.spec;
  Warnings warnings;
  for (std::size_t p = 0; p < silence->partitions.size(); ++p) {
    const std::vector<std::int64_t>& without_action = silence->partitions[p].without_action;
    const std::int64_t cells = std::accumulate(without_action.begin(), without_action.end(), std::int64_t{0});
    if (cells == 0) continue;
    std::vector<std::string> agents;
    for (std::size_t i = 0; i < without_action.size(); ++i) {
      if (without_action[i] > 0) agents.push_back(spec.agents[i].name);
    }
    const bool is_of_one = silence->partitions.size() < spec.coordination.partitions.size() ||
                           spec.coordination.partitions.size() == 1;
    const std::string partition =
        is_of_one ? ""
                  : fmt::format(" of the partition {}", quote_text(spec.coordination.partitions[p].name));
    warnings.push_back(
        {"silence", "/silence/actions",
         fmt::format(
             "in {} cell{}{} the communication-loss rule permits no action for {}; the tolerated silence "
             "there is 0",
             grouped(cells), cells == 1 ? "" : "s", partition, quote_list(agents, "or"))});
  }
  return warnings;
}

/// Levels of K' and of L, their set, and the projections.
MemoryNeed silence_memory(const EngineSizes& sizes, int threads) {
  const ProblemSpec& spec = sizes.model().spec();
  if (!spec.silence) return {};
  const auto partitions = static_cast<double>(spec.coordination.partitions.size());
  MemoryNeed need{.kept = static_cast<double>(count_of_answers(spec)) * sizes.levels(),
                  .array = partitions * sizes.cells() * sizeof(std::int16_t)};
  if (spec.silence->has_then()) need.kept += sizes.levels() + sizes.set();
  std::vector<std::vector<InputClass>> all = {agent_classes(spec, sizes.model().inputs())};
  for (const PartitionSpec& partition : spec.coordination.partitions)
    all.push_back(input_classes(spec, sizes.model().inputs(), partition));
  for (const std::vector<InputClass>& classes : all) {
    need.work = std::max(
        need.work, sizes.groups(classes) + projection_bytes(sizes, classes) + silent_bytes(sizes, classes));
  }
  need.work += sizes.wave(threads) + sizes.level_delta();
  return need;
}

}  // namespace

const SilencePartition& silence_of(const Answers& answers, std::size_t p) {
  const std::vector<SilencePartition>& partitions = answers.get<Silence>().partitions;
  return partitions[std::min(p, partitions.size() - 1)];
}

const CellSet& silence_set(const Answers& answers) {
  return answers.context.spec.silence->has_then() ? answers.get<Silence>().set
                                                  : answers.get<Invariance>().invariant;
}

const Answer silence_answer = {.stages = silence_stages,
                               .memory = silence_memory,
                               .fields = silence_fields,
                               .fill = fill_silence_fields,
                               .summarise = summarise_silence,
                               .describe = describe_silence,
                               .advise = advise_on_silence,
                               .policies = silence_policies,
                               .check = check_silence,
                               .check_memory = silence_check_memory};

}  // namespace coordreq
