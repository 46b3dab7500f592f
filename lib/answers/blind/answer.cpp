#include "answers/blind/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "answers/blind/blind_layers.hpp"
#include "answers/checking/all_checks.hpp"
#include "answers/countdown/fields.hpp"
#include "answers/countdown/stage.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/kept_levels.hpp"
#include "answers/layers/answer.hpp"
#include "answers/work_json.hpp"
#include "base/index.hpp"
#include "choices/projection_bytes.hpp"
#include "spec/problem_spec.hpp"
#include "spec/sight.hpp"
#include "spec/silence.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

ClassFibres fibres_of(const ProblemSpec& spec, const UniformGrid& grid, const PartitionSpec& partition) {
  ClassFibres fibres;
  for (const std::vector<std::int32_t>& agents : partition.classes) {
    const std::vector<std::size_t> seen = seen_states(spec, agents);
    fibres.push_back(seen.size() == spec.states.size() ? std::nullopt
                                                       : std::optional<Fibres>(std::in_place, grid, seen));
  }
  return fibres;
}

/// The actions and the sight of the classes of a partition, and the layers of agents who see everything.
struct BlindSight {
  BlindSight(const Answers& answers, std::size_t p, const StageWork& work)
      : grouping(*answers.context.engine,
                 input_classes(answers.context.spec, answers.context.abstraction->inputs,
                               answers.context.spec.coordination.partitions[p]),
                 work.team),
        projections(answers.get<NonterminalController>().controller, grouping, work.team,
                    answers.context.equal(), true),
        fibres(fibres_of(answers.context.spec, answers.context.engine->grid(),
                         answers.context.spec.coordination.partitions[p])),
        sources{projections, *answers.get<NonterminalController>().controller.invariant, fibres},
        problem{sources,
                *answers.context.hull,
                answers.get<PartitionLayers>().partitions[p],
                answers.context.spec.coordination.max_delay,
                answers.context.tiles.has_value(),
                answers.context.terminal_or_null()} {}
  BlindSight(const BlindSight&) = delete;
  BlindSight& operator=(const BlindSight&) = delete;
  ~BlindSight() = default;

  ActionGrouping grouping;
  Projections projections;
  ClassFibres fibres;
  SilentSources sources;
  BlindProblem problem;
};

void find_blind_layers_of(std::size_t p, Answers& answers, const StageWork& work) {
  const AnalysisContext& context = answers.context;
  if (answers.find<Blind>() == nullptr)
    answers.add(Blind{std::vector<BlindPartition>(context.spec.coordination.partitions.size())});
  const auto find = [&](const WaveWatch& watch, WaveCounts& counts) {
    work.enter_substage("projections");
    const BlindSight partition(answers, p, work);
    work.enter_substage("");
    return find_blind_levels(partition.problem, watch, work.team, counts);
  };
  find_layers(context, *context.engine, answers.get<Invariance>().invariant, work,
              answers.get<Blind>().partitions[p].layers, find);
}

/// Gives tables their sizes, before they are loaded.
void size_tables(const Answers& answers, std::size_t p, std::vector<SilentTable>& tables) {
  const ProblemSpec& spec = answers.context.spec;
  const PartitionSpec& partition = spec.coordination.partitions[p];
  const ClassFibres fibres = fibres_of(spec, answers.context.engine->grid(), partition);
  const std::vector<InputClass> classes = input_classes(spec, answers.context.abstraction->inputs, partition);
  tables.assign(fibres.size(), {});
  for (std::size_t c = 0; c < tables.size(); ++c) {
    if (!fibres[c]) continue;
    tables[c].actions = classes[c].actions();
    tables[c].seen_depth.resize(at(fibres[c]->count()));
    tables[c].missing_depth.resize(tables[c].seen_depth.size() * at(tables[c].actions));
  }
}

void serialise_tables(Archive& archive, std::int64_t steps, std::vector<SilentTable>& tables) {
  const auto are_depths = [steps](const std::vector<std::uint8_t>& depths) {
    return std::ranges::all_of(depths, [steps](std::uint8_t depth) { return depth <= steps; });
  };
  for (SilentTable& table : tables) {
    archive.list(table.seen_depth);
    archive.list(table.missing_depth);
    archive.expect(are_depths(table.seen_depth) && are_depths(table.missing_depth),
                   "a silent table has more steps than there are");
  }
}

/// The delay that a level of K stands for, as DelayLayers has it.
template <class Level>
std::int64_t steps_of_level(Level level, std::int64_t top) {
  return level == LevelRows<Level>::kTop ? top : std::int64_t{level} - 1;
}

/// Cells of K where both delays are the same. Together.
std::int64_t count_equal(const AnalysisContext& context, const CellSet& invariant, const DelayLayers& one,
                         const DelayLayers& other) {
  std::int64_t equal = 0;
  one.layers_of.visit([&](const auto& first) {
    other.layers_of.visit([&](const auto& second) {
      const RowShare::Range local = local_rows(context.shared_rows(), first.rows());
      for (std::int64_t r = local.begin; r < local.end; ++r) {
        const auto* const a = first.row(r);
        const auto* const b = second.row(r);
        for_each_bit(invariant.row(r), [&](std::int64_t x) {
          if (steps_of_level(a[x], one.top_delay()) == steps_of_level(b[x], other.top_delay())) ++equal;
        });
      }
    });
  });
  return sum_of_all(context.shared_rows(), equal);
}

/// Finds the levels of blind delays, and the tables, from the levels of B.
void find_blind_delays_of(std::size_t p, Answers& answers, const StageWork& work) {
  const AnalysisContext& context = answers.context;
  BlindPartition& blind_partition = answers.get<Blind>().partitions[p];
  const auto serialise_all = [&answers, &blind_partition](Archive& archive) {
    LevelBounds bounds = layer_bounds(answers.context, answers.get<Invariance>().invariant);
    ++bounds.most;
    serialise(archive, *answers.context.engine, bounds, blind_partition.delays.layers_of);
    serialise_tables(archive, std::min(blind_partition.table_steps(), SilentTable::kMostSteps),
                     blind_partition.tables);
  };
  size_tables(answers, p, blind_partition.tables);
  const bool is_kept = work.store != nullptr && work.store->take(serialise_all) == StageStore::Kept::finished;
  if (!is_kept) {
    work.enter_substage("projections");
    const BlindSight partition(answers, p, work);
    work.enter_substage("");
    blind_partition.delays.layers_of = find_blind_delays(partition.problem, blind_partition.layers.layers_of,
                                                         blind_partition.layers.fixed_point_index, work.team);
    const std::int64_t deepest =
        blind_partition.layers.truncated ? blind_partition.layers.top_delay() : blind_partition.table_steps();
    blind_partition.tables =
        find_silent_tables(partition.sources, blind_partition.layers.layers_of, deepest, work.team);
  }
  blind_partition.delays.sizes = blind_partition.layers.sizes;
  blind_partition.delays.fixed_point_index = blind_partition.layers.fixed_point_index;
  blind_partition.delays.truncated = blind_partition.layers.truncated;
  const LevelMap::Histogram found = blind_partition.delays.layers_of.histogram(work.team);
  blind_partition.greatest = std::max<std::int64_t>(0, std::ssize(found.finite) - 2);
  if (blind_partition.layers.truncated)
    blind_partition.greatest =
        std::max<std::int64_t>(blind_partition.greatest, blind_partition.layers.top_delay());
  blind_partition.as_much = count_equal(context, answers.get<Invariance>().invariant, blind_partition.delays,
                                        answers.get<PartitionLayers>().partitions[p]);
  if (work.store != nullptr) work.store->finish(serialise_all);
}

Json blind_json(const AnalysisContext& context, const DelayLayers& layers, std::int64_t as_much) {
  Json json = layers_json(context, layers);
  json["as_much"] = as_much;
  return json;
}

/// Adds Blind, if some agent does not see all states: for each partition of several classes "blind layers
/// PARTITION", then "blind delays PARTITION".
std::vector<Stage> blind_stages(const ProblemSpec& spec) {
  if (!has_limited_sight(spec)) return {};
  std::vector<Stage> stages;
  for (std::size_t p = 0; p < spec.coordination.partitions.size(); ++p) {
    const PartitionSpec& partition = spec.coordination.partitions[p];
    if (partition.classes.size() == 1) continue;
    stages.push_back({"blind layers " + partition.name, [p](Answers& answers, const StageWork& work) {
                        find_blind_layers_of(p, answers, work);
                      }});
    stages.push_back({"blind delays " + partition.name, [p](Answers& answers, const StageWork& work) {
                        find_blind_delays_of(p, answers, work);
                      }});
  }
  return stages;
}

void summarise_blind(const Answers& answers, Json& summary, Json& work) {
  const ProblemSpec& spec = answers.context.spec;
  if (!has_limited_sight(spec)) return;
  for (std::size_t p = 0; p < spec.coordination.partitions.size(); ++p) {
    const DelayLayers& layers = blind_layers(answers, p);
    Json& entry = summary["partitions"][p]["blind"];
    const bool is_one_class = spec.coordination.partitions[p].classes.size() == 1;
    entry = blind_json(answers.context, layers,
                       is_one_class ? layers.sizes.front() : answers.get<Blind>().partitions[p].as_much);
    if (!is_one_class)
      work["blind layers " + spec.coordination.partitions[p].name] = work_json(layers.counts);
  }
}

void describe_blind(const ProblemSpec& spec, const FieldSource& source, Json& info) {
  if (has_limited_sight(spec)) describe_layers(spec, source, kBlindKind, info);
}

/// Warns that other answers are about agents who see everything.
Warnings advise_on_blind(const Answers& answers) {
  const ProblemSpec& spec = answers.context.spec;
  if (!has_limited_sight(spec)) return {};
  std::vector<std::string> others;
  if (spec.goal) others.emplace_back("goal");
  if (spec.coordination.horizon) others.emplace_back("coordination/horizon");
  if (spec.coordination.convention) others.emplace_back("coordination/convention");
  if (spec.network) others.emplace_back("network");
  if (spec.risk) others.emplace_back("risk");
  if (spec.silence && !all_have_rules(*spec.silence)) others.emplace_back("silence");
  if (others.empty()) return {};
  return {{"sight", "/agents",
           fmt::format("results for {} assume that agents observe the full state; 'sees' is ignored",
                       quote_list(others, "and"))}};
}

/// Levels of B and of the delays, and a byte for each action of each fibre.
MemoryNeed blind_memory(const EngineSizes& sizes, int threads) {
  const ProblemSpec& spec = sizes.model().spec();
  if (!has_limited_sight(spec)) return {};
  const auto partitions = static_cast<double>(spec.coordination.partitions.size());
  MemoryNeed need{.array = partitions * sizes.cells() * sizeof(std::int16_t)};
  for (const PartitionSpec& partition : spec.coordination.partitions) {
    if (partition.classes.size() == 1) continue;
    const std::vector<InputClass> classes = input_classes(spec, sizes.model().inputs(), partition);
    double masks = 0, tables = 0;
    for (std::size_t c = 0; c < classes.size(); ++c) {
      masks += sizes.set() * static_cast<double>(classes[c].actions());
      double fibres = 1;
      for (const std::size_t i : seen_states(spec, partition.classes[c]))
        fibres *= static_cast<double>(spec.states[i].grid.count);
      if (fibres < sizes.cells()) tables += fibres * static_cast<double>(classes[c].actions() + 1);
    }
    need.kept += 2 * sizes.levels() + tables;
    need.work =
        std::max(need.work, sizes.groups(classes) + projection_bytes(sizes, classes) + masks + tables);
  }
  need.work += sizes.wave(threads) + sizes.level_delta() + sizes.set();
  return need;
}

}  // namespace

std::int64_t BlindPartition::table_steps() const {
  const std::int64_t known = layers.truncated ? layers.top_delay() : layers.fixed_point_index;
  return std::clamp<std::int64_t>(known, 1, SilentTable::kMostSteps);
}

const Answer blind_answer = {.stages = blind_stages,
                             .memory = blind_memory,
                             .fields = blind_fields,
                             .fill = fill_blind_fields,
                             .summarise = summarise_blind,
                             .describe = describe_blind,
                             .advise = advise_on_blind,
                             .policies = blind_policies,
                             .explain = explain_blind,
                             .check = check_blind,
                             .check_memory = blind_check_memory};

}  // namespace coordreq
