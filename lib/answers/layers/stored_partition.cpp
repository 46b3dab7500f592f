#include "answers/layers/stored_partition.hpp"

#include <algorithm>

#include "answers/field_parts.hpp"
#include "answers/paths.hpp"
#include "spec/partition_names.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

std::vector<StoredPartition> read_partition_values(const ProblemSpec& spec, const FieldSource& source,
                                                   const std::string& prefix) {
  const std::vector<std::int64_t> sizes = source.integers(prefix + "layer_size");
  const std::vector<std::int64_t> fixed_points = source.integers(prefix + "fixed_point_index");
  const std::vector<PartitionSpec>& partitions = spec.coordination.partitions;
  const std::size_t layers = sizes.size() / partitions.size();
  std::vector<StoredPartition> result;
  for (std::size_t p = 0; p < partitions.size(); ++p) {
    StoredPartition& partition = result.emplace_back();
    partition.name = partitions[p].name;
    for (const auto& agents : partitions[p].classes) {
      partition.classes.push_back(class_name(spec.agents, agents));
      partition.actions.push_back(joint_actions(spec, inputs_of(spec, agents)));
    }
    if (fixed_points[p] >= static_cast<std::int64_t>(layers))
      source.fail("found " + std::to_string(fixed_points[p]) + ", expected a layer or -1",
                  prefix + "fixed_point_index");
    partition.fixed_point_index = static_cast<std::int32_t>(fixed_points[p]);
    const auto row = sizes.begin() + static_cast<std::ptrdiff_t>(p * layers);
    partition.padded_sizes.assign(row, row + static_cast<std::ptrdiff_t>(layers));
    partition.layer_sizes = partition.padded_sizes;
    if (!partition.truncated())
      partition.layer_sizes.resize(static_cast<std::size_t>(partition.fixed_point_index) + 1);
  }
  return result;
}

StoredLayers read_layer_lists(const ProblemSpec& spec, const PartitionSpec& partition,
                              const FieldSource& source) {
  const std::string path = paths::layers(partition);
  StoredLayers layers{source.list(path + "/start"), source.list(path + "/cell")};
  if (!std::is_sorted(layers.start.begin(), layers.start.end()) || layers.start.front() != 0 ||
      layers.start.back() != layers.cell.size())
    source.fail("does not ascend from 0 to the number of cells", path + "/start");
  const std::uint64_t cells = cell_count(spec);
  if (std::any_of(layers.cell.begin(), layers.cell.end(), [&](std::uint64_t x) { return x >= cells; }))
    source.fail("a cell that the grid does not have", path + "/cell");
  return layers;
}

}  // namespace coordreq
