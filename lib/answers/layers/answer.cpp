#include "answers/layers/answer.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "answers/checking/all_checks.hpp"
#include "answers/countdown/best_cells.hpp"
#include "answers/countdown/fields.hpp"
#include "answers/countdown/leaving_cells.hpp"
#include "answers/countdown/stage.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/kept_levels.hpp"
#include "answers/layers/refinement.hpp"
#include "answers/layers/stored_partition.hpp"
#include "answers/paths.hpp"
#include "answers/work_json.hpp"
#include "choices/projection_bytes.hpp"
#include "spec/partition_names.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Whether unbounded cells whose runs leave through a `safe` side are counted. Not if all agents coordinate,
/// who are never silent, nor with a controller file, since classes may take joint inputs that it does not
/// list.
bool counts_leaving(const AnalysisContext& context, const DelayLayers& layers) {
  return !layers.truncated && !context.listed && has_safe_side(context.spec);
}

/// @pre unchecked: the layers of all coarser partitions are known.
void find_layers_of(std::size_t p, Answers& answers, const StageWork& work) {
  const AnalysisContext& context = answers.context;
  const CoordinationSpec& coordination = context.spec.coordination;
  std::vector<DelayLayers>& all = answers.get<PartitionLayers>().partitions;
  const CellSet& invariant = answers.get<Invariance>().invariant;
  if (coordination.partitions[p].classes.size() == 1) {
    all[p] = coordinated_layers(*context.engine, invariant, coordination.max_delay, work.team,
                                context.tiles.has_value());
    return;
  }
  std::optional<PartitionActions> actions;
  const auto projections = [&]() -> const Projections& {
    if (!actions) {
      work.enter_substage("projections");
      actions.emplace(answers, p, work.team);
      work.enter_substage("");
    }
    return actions->projections;
  };
  DelayLayers& layers = all[p];
  find_layers(context, *context.engine, invariant, work, layers,
              [&](const WaveWatch& watch, WaveCounts& counts) {
                std::vector<const LevelMap*> coarser;
                for (const std::size_t q : next_coarser(coordination.partitions, p))
                  coarser.push_back(&all[q].layers_of);
                return find_layer_levels(*context.engine, *context.hull, invariant, projections(), coarser,
                                         coordination.max_delay, watch, work.team, counts,
                                         context.terminal_or_null());
              });
  if (!counts_leaving(context, layers)) return;
  layers.leaving.emplace();
  if (layers.sizes.back() == context.terminal_cells) return;
  const Projections& silent = projections();
  work.enter_substage("safe sides");
  layers.leaving = count_leaving_cells(
      answers, silent, layers,
      {.step =
           work.step
               ? [&](const WaveStep&
                         step) { work.step(step, context.engine->grid().points() / context.engine->rows()); }
               : std::function<void(const WaveStep&)>()},
      work.team);
}

/// |Z_0 \ Z_D|; a layer beyond `max_delay` counts as empty, but for the cells of a goal that ends the task.
std::int64_t cells_bound_to_connect(const AnalysisContext& context, const DelayLayers& layers) {
  const std::int64_t connection_delay = context.spec.coordination.connection_delay;
  const auto known = static_cast<std::int64_t>(layers.sizes.size());
  if (connection_delay >= known && layers.truncated) return layers.sizes.front() - context.terminal_cells;
  return layers.sizes.front() - layers.sizes[static_cast<std::size_t>(std::min(connection_delay, known - 1))];
}

/// The largest delay times the period, over the nonterminal cells; null if a delay is unbounded
/// or there are no such cells.
Json longest_delay(const AnalysisContext& context, const DelayLayers& layers) {
  const std::int64_t fixed_point = layers.truncated ? context.terminal_cells : layers.sizes.back();
  if (fixed_point != context.terminal_cells || layers.sizes.front() == context.terminal_cells) return {};
  // Z_k shrinks strictly, so the last layer that is not empty holds the largest delay.
  const std::size_t steps = layers.sizes.size() - (layers.truncated ? 1 : 2);
  return nearest_double(context.spec.dynamics.period * Rational(static_cast<unsigned long>(steps)));
}

/// The work of counting the cells from which runs leave.
Json leaving_work_json(const LeavingCounts& counts) {
  Json json = work_json(counts.wave);
  json["rows_near"] = counts.rows_near;
  json["rows_read"] = counts.rows_read;
  return json;
}

/// The sides of the domain at which the cells of the longest finite delay lie, if all lie at one.
Json best_at_json(const AnalysisContext& context, const DelayLayers& layers) {
  Json json = Json::array();
  for (const GridSide& side : layers.best_sides) {
    const GridDimension& dimension = context.abstraction->grid[side.dimension];
    json.push_back({{"state", dimension.name},
                    {"value", nearest_double(dimension.point(side.above ? dimension.count - 1 : 0))}});
  }
  return json;
}

Json partition_json(const AnalysisContext& context, const PartitionSpec& partition,
                    const DelayLayers& layers) {
  const ProblemSpec& spec = context.spec;
  Json json;
  json["name"] = partition.name;
  json["classes"] = Json::array();
  for (const auto& agents : partition.classes) json["classes"].push_back(class_name(spec.agents, agents));
  json["F"] = layers.truncated ? Json() : Json(layers.fixed_point_index);
  json["fixed_point"] = layers.truncated ? Json() : Json(layers.sizes.back());
  json["leaving"] = layers.leaving ? Json(layers.leaving->cells) : Json();
  json["layers"] = layers.sizes;
  json["truncated"] = layers.truncated;
  json["never_without_connection"] = cells_bound_to_connect(context, layers);
  json["max_delay_time"] = longest_delay(context, layers);
  json["best_state"] = best_state_json(context, layers);
  json["best_at_edges"] = best_at_json(context, layers);
  return json;
}

void summarise_layers(const Answers& answers, Json& summary, Json& work) {
  const ProblemSpec& spec = answers.context.spec;
  summary["period"] = nearest_double(spec.dynamics.period);
  summary["period_unit"] = spec.dynamics.unit;
  summary["connection_delay"] = spec.coordination.connection_delay;
  summary["partitions"] = Json::array();
  for (std::size_t p = 0; p < spec.coordination.partitions.size(); ++p) {
    const PartitionSpec& partition = spec.coordination.partitions[p];
    const DelayLayers& layers = answers.get<PartitionLayers>().partitions[p];
    summary["partitions"].push_back(partition_json(answers.context, partition, layers));
    work["layers " + partition.name] = work_json(layers.counts);
    if (layers.leaving)
      work["helpers"]["leaving cells " + partition.name] = leaving_work_json(*layers.leaving);
  }
}

/// Fails if an F is no layer, or if a list of layers has another length.
void examine_layers(const ProblemSpec& spec, const FieldSource& source) {
  const std::vector<StoredPartition> partitions = read_partition_values(spec, source);
  for (std::size_t p = 0; spec.output.layers && p < partitions.size(); ++p) {
    const std::string path = paths::layers(spec.coordination.partitions[p]) + "/start";
    source.expect_length(path, partitions[p].layer_sizes.size() + 1);
  }
}

void describe_layers(const ProblemSpec& spec, const FieldSource& source, Json& info) {
  info["partitions"] = Json::array();
  for (const StoredPartition& partition : read_partition_values(spec, source)) {
    Json entry = {{"name", partition.name}, {"classes", partition.classes}};
    info["partitions"].push_back(std::move(entry));
  }
  describe_layers(spec, source, kDelayKind, info);
}

/// Levels of all partitions are kept; projections are those of one partition at a time.
MemoryNeed layers_memory(const EngineSizes& sizes, int threads) {
  const ProblemSpec& spec = sizes.model().spec();
  const auto partitions = static_cast<double>(spec.coordination.partitions.size());
  MemoryNeed need{.kept = partitions * sizes.levels(),
                  .array = partitions * sizes.cells() * sizeof(std::int16_t)};
  double actions = 0;
  for (const PartitionSpec& partition : spec.coordination.partitions) {
    const std::vector<InputClass> classes = input_classes(spec, sizes.model().inputs(), partition);
    const double groups = sizes.groups(classes);
    need.work = std::max(need.work, groups + projection_bytes(sizes, classes));
    if (!spec.output.actions) continue;
    actions = std::max(actions, groups);
    for (const InputClass& input_class : classes)
      need.array = std::max(need.array, sizes.packed_pairs(input_class.actions()));
  }
  need.work += sizes.wave(threads) + sizes.level_delta();
  if (has_safe_side(spec)) need.work += sizes.levels() + 2 * sizes.set();
  if (spec.output.actions) need.written += actions + sizes.readers(threads);
  // Each process sorts an equal share of the cells, after it was sent their layers.
  if (spec.output.layers) need.written += std::min(sizes.cells(), 2 * sizes.lanes()) * sizeof(std::uint32_t);
  return need;
}

/// Adds PartitionLayers: "layers PARTITION" for each partition, coarser ones before finer ones.
std::vector<Stage> layers_stages(const ProblemSpec& spec) {
  const std::vector<PartitionSpec>& partitions = spec.coordination.partitions;
  std::vector<Stage> stages;
  for (const std::size_t p : coarsest_first(partitions)) {
    stages.push_back({"layers " + partitions[p].name, [p](Answers& answers, const StageWork& work) {
                        const std::size_t count = answers.context.spec.coordination.partitions.size();
                        if (answers.find<PartitionLayers>() == nullptr)
                          answers.add(PartitionLayers{std::vector<DelayLayers>(count)});
                        find_layers_of(p, answers, work);
                      }});
  }
  return stages;
}

}  // namespace

PartitionActions::PartitionActions(const Answers& answers, std::size_t p, ThreadTeam& team)
    : grouping(*answers.context.engine,
               input_classes(answers.context.spec, answers.context.abstraction->inputs,
                             answers.context.spec.coordination.partitions[p]),
               team),
      symmetry(
          answers.context.symmetry(input_classes(answers.context.spec, answers.context.abstraction->inputs,
                                                 answers.context.spec.coordination.partitions[p]))),
      projections(answers.get<NonterminalController>().controller, grouping, team,
                  answers.context.equal(symmetry ? &*symmetry : nullptr)) {}

const Answer layers_answer = {.stages = layers_stages,
                              .memory = layers_memory,
                              .fields = layer_fields,
                              .fill = fill_layer_fields,
                              .summarise = summarise_layers,
                              .examine = examine_layers,
                              .describe = describe_layers,
                              .policies = layer_policies,
                              .check = check_layers};

}  // namespace coordreq
