#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "answers/countdown/delay_layers.hpp"
#include "answers/countdown/fields.hpp"
#include "answers/field_arrays.hpp"
#include "answers/field_parts.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/last_value_cache.hpp"
#include "answers/layers/answer.hpp"
#include "answers/paths.hpp"
#include "answers/step_codes.hpp"
#include "choices/action_bits.hpp"
#include "spec/partition_names.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

std::map<std::string, std::string> countdown_meanings(const ProblemSpec& spec) {
  const bool takes_time = spec.coordination.connection_delay > 0;
  return {{"connection_must_stand_already", "a connection must exist already"},
          {"never", "never need to connect"},
          {"not_safe", "none"},
          {"not_invariant", "none"},
          {"0", takes_time ? "start to connect now" : "coordinate now"}};
}

void add_steps(Fields& fields, const ProblemSpec& spec) {
  const FieldFlag outside_safe{kOutsideSafe, "not_safe"};
  const FieldFlag outside_invariant{kOutsideInvariant, "not_invariant"};
  fields.push_back(steps_field(
      "delay", spec, kOutsideSafe,
      described("largest number of steps without coordination that keeps the system safe") +
          std::vector<FieldAttribute>{flags({outside_safe, outside_invariant, {kLargestValue, "unbounded"}})},
      {.column = "delay",
       .compared = "delay",
       .query = {.label = "delay",
                 .meanings = {{"not_safe", "none: the cell is not safe"},
                              {"not_invariant",
                               "none: on this grid no coordination keeps the system safe from here"},
                              {"unbounded", "unbounded: safe without coordination indefinitely"}}},
       .map = {.kind = "delay"}},
      "/fixed_point_index"));
  fields.push_back(
      steps_field("trigger", spec, kMustBeConnected,
                  described("steps until the agents must start to connect") +
                      std::vector<FieldAttribute>{flags({{kMustBeConnected, "connection_must_stand_already"},
                                                         outside_safe,
                                                         outside_invariant,
                                                         {kLargestValue, "never"}}),
                                                  {"connection_delay", spec.coordination.connection_delay}},
                  {.column = "countdown",
                   .below_zero = kMustBeConnected,
                   .query = {.label = "connect in", .meanings = countdown_meanings(spec)}}));
}

void add_lists(Fields& fields, const PartitionSpec& partition, std::uint64_t cells, std::uint64_t layers) {
  const std::string group = paths::layers(partition);
  constexpr FieldSection kSection = FieldSection::layer_lists;
  fields.push_back(bare_scale(group + "/bound", kSection, 2, layers + 1));
  fields.push_back(bare_scale(group + "/position", kSection, 0, cells));
  fields.push_back({.path = group + "/start",
                    .section = kSection,
                    .types = {ElementType::uint64},
                    .axes = {group + "/bound"},
                    .attributes = described("layer T(k) is cell[start[k] : start[k+1]]")});
  fields.push_back({.path = group + "/cell",
                    .section = kSection,
                    .types = {ElementType::uint32, ElementType::uint64},
                    .axes = {group + "/position"},
                    .most = static_cast<std::int64_t>(cells) - 1,
                    .attributes = described("row-major linear index of the cell, by layer, ascending")});
}

void fill_lists(const Answers& answers, const PartitionSpec& partition, const DelayLayers& layers,
                const std::shared_ptr<CellsCache>& cache, FieldValues& values) {
  const std::string group = paths::layers(partition);
  std::vector<std::uint64_t> start = layer_starts(layers);
  values.lengths[group + "/bound"] = start.size();
  values.lengths[group + "/position"] = start.back();
  values.entries[group + "/start"].array = owned_array(ElementType::uint64, std::move(start));
  values.entries[group + "/cell"].array = layer_cells(layers, *answers.context.order, cache);
}

using GroupingCache = LastValueCache<std::size_t, ActionGrouping>;

/// The admissible actions of a class of partition p.
ResultArray action_array(const Answers& answers, std::size_t p, std::size_t c,
                         const std::shared_ptr<GroupingCache>& cache) {
  return {ElementType::uint8, [&answers, p, c, cache](std::uint64_t begin, std::uint64_t count, void* out) {
            const AnalysisContext& context = answers.context;
            const auto grouping = cache->get(p, [&] {
              ThreadTeam alone(1);  // the other threads wait for it, in a loop of their own
              const PartitionSpec& partition = context.spec.coordination.partitions[p];
              return ActionGrouping(*context.engine,
                                    input_classes(context.spec, context.abstraction->inputs, partition),
                                    alone);
            });
            fill_action_bits(answers.get<Controller>(), *grouping, c, begin, count, out);
          }};
}

}  // namespace

namespace paths {

std::string layers(const PartitionSpec& partition) {
  return "/layers/" + partition.name;
}

std::string actions(const ProblemSpec& spec, const PartitionSpec& partition, std::size_t class_number) {
  return "/actions/" + partition.name + "/" + class_name(spec.agents, partition.classes[class_number]);
}

}  // namespace paths

/// Delays and triggers of all partitions, sizes of layers, F; on request the layers' cells, and the
/// admissible actions of each class.
Fields layer_fields(const ProblemSpec& spec) {
  const std::uint64_t cells = cell_count(spec);
  const std::uint64_t layers = most_layers(spec, cells);
  Fields fields;
  add_steps(fields, spec);
  add_sizes(fields, kDelayKind, cells, spec);
  for (const PartitionSpec& partition : spec.coordination.partitions) {
    if (spec.output.layers) add_lists(fields, partition, cells, layers);
    for (std::size_t c = 0; spec.output.actions && c < partition.classes.size(); ++c) {
      add_bits(fields, paths::actions(spec, partition, c), FieldSection::actions, spec,
               inputs_of(spec, partition.classes[c]), "admissible joint actions of the class, one bit each");
    }
  }
  return fields;
}

/// Large data of a partition are made only while they are written: for many partitions together they would
/// take more memory than everything else.
void fill_layer_fields(const Answers& answers, ThreadTeam& /*team*/, FieldValues& values) {
  const std::vector<DelayLayers>& partitions = answers.get<PartitionLayers>().partitions;
  fill_steps(answers, pointers_to(partitions), paths::kDelay, paths::kTrigger, values);
  fill_sizes(pointers_to(partitions), kDelayKind, values);
  const ProblemSpec& spec = answers.context.spec;
  const auto cells = std::make_shared<CellsCache>();
  const auto grouping = std::make_shared<GroupingCache>();
  for (std::size_t p = 0; p < partitions.size(); ++p) {
    const PartitionSpec& partition = spec.coordination.partitions[p];
    if (spec.output.layers) fill_lists(answers, partition, partitions[p], cells, values);
    for (std::size_t c = 0; spec.output.actions && c < partition.classes.size(); ++c)
      values.entries[paths::actions(spec, partition, c)].array = action_array(answers, p, c, grouping);
  }
}

}  // namespace coordreq
