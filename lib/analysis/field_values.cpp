#include "analysis/field_values.hpp"

#include <algorithm>
#include <stdexcept>

#include "answers/requirements/fields.hpp"

namespace coordreq {
namespace {

std::uint64_t cell_count(const ResultContent& content) {
  std::uint64_t cells = 1;
  for (const ResultAxis& axis : content.axes) cells *= axis.is_state ? axis.points.size() : 1;
  return cells;
}

/// Delays or triggers of all partitions in one array.
ResultArray steps_array(const ResultContent& content, ResultArray ResultPartition::*member) {
  std::vector<ResultArray> parts;
  for (const ResultPartition& partition : content.partitions) parts.push_back(partition.*member);
  return stacked_array(cell_count(content), std::move(parts));
}

/// |Z_k| of all partitions; constant once fixed.
void add_layers(const ResultContent& content, FieldValues& values) {
  std::size_t count = 1;
  for (const ResultPartition& partition : content.partitions)
    count = std::max(count, partition.layer_sizes.size());
  std::vector<std::uint64_t> sizes;
  std::vector<std::int32_t> fixed_points;
  for (const ResultPartition& partition : content.partitions) {
    std::vector<std::uint64_t> row = partition.layer_sizes;
    row.resize(count, row.empty() ? 0 : row.back());
    sizes.insert(sizes.end(), row.begin(), row.end());
    fixed_points.push_back(partition.fixed_point_index);
  }
  values.lengths["/layer"] = count;
  values.entries["/layer_size"].array = owned_array(ElementType::uint64, std::move(sizes));
  values.entries["/fixed_point_index"].array = owned_array(ElementType::int32, std::move(fixed_points));
  for (const ResultPartition& partition : content.partitions) {
    if (!partition.layers) continue;
    const std::string group = "/layers/" + partition.name;
    values.lengths[group + "/bound"] = partition.layers->start.size();
    values.lengths[group + "/position"] = partition.layers->start.back();
    values.entries[group + "/start"].array = owned_array(ElementType::uint64, partition.layers->start);
    values.entries[group + "/cell"].array = partition.layers->cell;
  }
}

void add_bits(const std::string& path, const ResultBits& bits, FieldValues& values) {
  values.entries[path].array = {ElementType::uint8, bits.fill};
}

void add_actions(const ResultContent& content, FieldValues& values) {
  for (const ResultPartition& partition : content.partitions) {
    for (const ResultBits& bits : partition.actions)
      add_bits("/actions/" + partition.name + "/" + bits.class_name, bits, values);
  }
  for (const ResultBits& bits : content.convention)
    add_bits("/actions:convention/" + bits.class_name, bits, values);
  if (content.controller) add_bits("/controller", *content.controller, values);
  if (!content.listed) return;
  add_bits("/controller:file", *content.listed, values);
  values.entries["/controller:file"].attributes["sha256"] = content.listed_sha256;
}

}  // namespace

FieldValues field_values(const ResultContent& content) {
  FieldValues values;
  values.entries["/safe"] = {.array = content.safe, .attributes = {{"cells", content.safe_cells}}};
  values.entries["/invariant"] = {.array = content.invariant,
                                  .attributes = {{"cells", content.invariant_cells}}};
  values.entries["/collision_time"] = {.array = content.collision_time,
                                       .attributes = {{"iterations", content.iterations}}};
  values.entries["/delay"].array = steps_array(content, &ResultPartition::delay);
  values.entries["/trigger"].array = steps_array(content, &ResultPartition::trigger);
  if (content.triggers_are_delays) values.entries["/trigger"].equals = "/delay";
  add_layers(content, values);
  add_actions(content, values);
  for (const ResultTable& table : content.abstraction) {
    const std::string group = "/abstraction/" + table.state;
    values.entries[group + "/first"].array = owned_array(ElementType::int32, table.first);
    values.entries[group + "/last"].array = owned_array(ElementType::int32, table.last);
  }
  for (const ResultMap& map : content.maps) {
    FieldValues::Entry& entry = values.entries["/" + map.name];
    entry.array = map.values;
    entry.attributes["cells"] = std::vector<std::uint64_t>(map.cells.begin(), map.cells.end());
  }
  add_requirement_values(content.requirements, values);
  return values;
}

}  // namespace coordreq
