#include "answers/layers/fields.hpp"

#include <algorithm>

#include "answers/field_parts.hpp"
#include "answers/layers/delay_layers.hpp"
#include "answers/layers/trigger_table.hpp"
#include "spec/partition_names.hpp"

namespace coordreq {
namespace {

Field steps_field(const std::string& name, const ProblemSpec& spec, std::int64_t least,
                  std::vector<FieldAttribute> attributes, FieldColumn column) {
  return {.path = "/" + name,
          .section = FieldSection::steps,
          .types = {ElementType::int16, ElementType::int32},
          .axes = cell_axes("/partition", spec),
          .least = least,
          .attributes = std::move(attributes),
          .column = std::move(column)};
}

void add_steps(Fields& fields, const ProblemSpec& spec) {
  const FieldFlag outside_safe{DelayLayers::kOutsideSafe, "not_safe"};
  const FieldFlag outside_invariant{DelayLayers::kOutsideInvariant, "not_invariant"};
  fields.push_back(steps_field(
      "delay", spec, DelayLayers::kOutsideSafe,
      described("largest number of steps without coordination that keeps the system safe") +
          std::vector<FieldAttribute>{flags({outside_safe, outside_invariant, {kLargestValue, "unbounded"}})},
      {"delay"}));
  fields.push_back(
      steps_field("trigger", spec, TriggerTable::kMustBeConnected,
                  described("steps until the agents must start to connect") +
                      std::vector<FieldAttribute>{
                          flags({{TriggerTable::kMustBeConnected, "connection_must_stand_already"},
                                 outside_safe,
                                 outside_invariant,
                                 {kLargestValue, "never"}}),
                          {"connection_delay", spec.coordination.connection_delay}},
                  {"countdown", TriggerTable::kMustBeConnected}));
}

void add_sizes(Fields& fields) {
  fields.push_back({.path = "/layer_size",
                    .section = FieldSection::layers,
                    .types = {ElementType::uint64},
                    .axes = {"/partition", "/layer"},
                    .attributes = described("number of cells in Z_k")});
  fields.push_back({.path = "/fixed_point_index",
                    .section = FieldSection::layers,
                    .types = {ElementType::int32},
                    .axes = {"/partition"},
                    .least = -1,
                    .attributes = described("F, the first k with Z_k = Z_(k+1)") +
                                  std::vector<FieldAttribute>{flags({{-1, "unknown_because_truncated"}})}});
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

/// The most layers that there can be: each but the last loses a cell.
std::uint64_t most_layers(const ProblemSpec& spec, std::uint64_t cells) {
  const std::optional<std::int64_t>& most = spec.coordination.max_delay;
  return 1 + (most ? std::min(cells, static_cast<std::uint64_t>(*most)) : cells);
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

Fields layer_fields(const ProblemSpec& spec) {
  const std::uint64_t cells = cell_count(spec);
  const std::uint64_t layers = most_layers(spec, cells);
  Fields fields = {number_scale("/layer", FieldSection::axes, 1, layers, "number k of the layer")};
  add_steps(fields, spec);
  add_sizes(fields);
  for (const PartitionSpec& partition : spec.coordination.partitions) {
    if (spec.output.layers) add_lists(fields, partition, cells, layers);
    for (std::size_t c = 0; spec.output.actions && c < partition.classes.size(); ++c) {
      add_bits(fields, paths::actions(spec, partition, c), FieldSection::actions, spec,
               inputs_of(spec, partition.classes[c]), "admissible joint actions of the class, one bit each");
    }
  }
  return fields;
}

}  // namespace coordreq
