#include "answers/countdown/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "answers/countdown/best_cells.hpp"
#include "answers/field_arrays.hpp"
#include "answers/field_parts.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/layers/stored_partition.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

std::uint64_t most_layers(const ProblemSpec& spec, std::uint64_t losses) {
  const std::optional<std::int64_t>& most = spec.coordination.max_delay;
  return 1 + (most ? std::min(losses, static_cast<std::uint64_t>(*most)) : losses);
}

Field steps_field(const std::string& name, const ProblemSpec& spec, std::int64_t least,
                  std::vector<FieldAttribute> attributes, FieldDisplay display, std::string fixed_points) {
  return {.path = "/" + name,
          .kind = FieldKind::steps,
          .section = FieldSection::steps,
          .types = {ElementType::int16, ElementType::int32},
          .axes = cell_axes("/partition", spec),
          .least = least,
          .attributes = std::move(attributes),
          .display = std::move(display),
          .fixed_points = std::move(fixed_points)};
}

void add_sizes(Fields& fields, const CountdownKind& kind, std::uint64_t losses, const ProblemSpec& spec) {
  const std::string prefix = kind.prefix();
  fields.push_back(number_scale(prefix + "layer", FieldSection::axes, 1, most_layers(spec, losses),
                                "number k of the layer"));
  fields.push_back({.path = prefix + "layer_size",
                    .section = FieldSection::layers,
                    .types = {ElementType::uint64},
                    .axes = {"/partition", prefix + "layer"},
                    .attributes = described(fmt::format("number of cells in {}_k", kind.letter))});
  fields.push_back(
      {.path = prefix + "fixed_point_index",
       .section = FieldSection::layers,
       .types = {ElementType::int32},
       .axes = {"/partition"},
       .least = -1,
       .attributes = described(fmt::format("F, the first k with {0}_k = {0}_(k+1)", kind.letter)) +
                     std::vector<FieldAttribute>{flags({{-1, "unknown_because_truncated"}})}});
}

LayersOfPartitions pointers_to(const std::vector<DelayLayers>& partitions) {
  LayersOfPartitions pointers;
  for (const DelayLayers& layers : partitions) pointers.push_back(&layers);
  return pointers;
}

std::int64_t longest_delay(const LayersOfPartitions& partitions) {
  std::int64_t longest = 0;
  for (const DelayLayers* const layers : partitions) {
    // Z_F = Z_{F+1}: the longest finite delay is F - 1, or the `max_delay` that stopped the iteration.
    const std::int64_t last = std::ssize(layers->sizes) - 1;
    longest = std::max(longest, layers->truncated ? last : last - 1);
  }
  return longest;
}

void fill_sizes(const LayersOfPartitions& partitions, const CountdownKind& kind, FieldValues& values) {
  std::size_t count = 1;
  for (const DelayLayers* layers : partitions) count = std::max(count, layers->sizes.size());
  std::vector<std::uint64_t> sizes;
  std::vector<std::int32_t> fixed_points;
  for (const DelayLayers* layers : partitions) {
    for (std::size_t k = 0; k < count; ++k)
      sizes.push_back(static_cast<std::uint64_t>(layers->sizes[std::min(k, layers->sizes.size() - 1)]));
    fixed_points.push_back(layers->fixed_point_index);
  }
  const std::string prefix = kind.prefix();
  values.lengths[prefix + "layer"] = count;
  values.entries[prefix + "layer_size"].array = owned_array(ElementType::uint64, std::move(sizes));
  values.entries[prefix + "fixed_point_index"].array =
      owned_array(ElementType::int32, std::move(fixed_points));
}

void fill_steps(const Answers& answers, const LayersOfPartitions& partitions, const std::string& delay,
                const std::string& trigger, FieldValues& values,
                const std::function<ResultArray(ResultArray)>& finish) {
  const ProblemSpec& spec = answers.context.spec;
  const LevelMap& times = answers.get<Invariance>().collision_time;
  const CellOrder& order = *answers.context.order;
  const ElementType type = level_type(longest_delay(partitions));
  const std::int64_t connection_delay = spec.coordination.connection_delay;
  std::vector<ResultArray> delays, triggers;
  for (const DelayLayers* const layers : partitions) {
    delays.push_back(delay_array(*layers, times, order, type));
    if (finish) delays.back() = finish(std::move(delays.back()));
    if (trigger.empty()) continue;
    triggers.push_back(trigger_array(*layers, times, connection_delay, order, type));
    if (finish) triggers.back() = finish(std::move(triggers.back()));
  }
  values.entries[delay].array = stacked_array(cell_count(spec), std::move(delays));
  if (trigger.empty()) return;
  values.entries[trigger].array = stacked_array(cell_count(spec), std::move(triggers));
  if (connection_delay == 0) values.entries[trigger].equals = delay;
}

Json layers_json(const AnalysisContext& context, const DelayLayers& layers) {
  return {{"F", layers.truncated ? Json() : Json(layers.fixed_point_index)},
          {"layers", layers.sizes},
          {"fixed_point", layers.truncated ? Json() : Json(layers.sizes.back())},
          {"truncated", layers.truncated},
          {"best_state", best_state_json(context, layers)}};
}

void describe_layers(const ProblemSpec& spec, const FieldSource& source, const CountdownKind& kind,
                     Json& info) {
  const std::vector<StoredPartition> partitions = read_partition_values(spec, source, kind.prefix());
  for (std::size_t p = 0; p < partitions.size(); ++p) {
    const StoredPartition& stored = partitions[p];
    Json& partition = info["partitions"][p];
    Json& entry = *kind.name == '\0' ? partition : partition[kind.name];
    entry["F"] = stored.truncated() ? Json() : Json(stored.fixed_point_index);
    entry["layers"] = stored.layer_sizes;
    entry["truncated"] = stored.truncated();
  }
}

}  // namespace coordreq
