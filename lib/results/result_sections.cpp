#include "results/result_sections.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "results/hdf5_attributes.hpp"
#include "results/memory_array.hpp"
#include "results/results_paths.hpp"
#include "results/sha256.hpp"
#include "spec/unit_text.hpp"
#include "results/version.hpp"

namespace coordreq {
namespace {

using hdf5::set_attribute;
using Paths = std::vector<std::string>;

/// HDF5 attributes take 64 KiB.
constexpr std::size_t kMostCounted = 4096;

/// Arrays of `length` elements each, one after the other.
ResultArray stacked(ElementType type, std::uint64_t length, std::vector<const ResultArray*> parts) {
  return {type, [=](std::uint64_t begin, std::uint64_t count, void* out) {
            auto* place = static_cast<std::byte*>(out);
            while (count > 0) {
              const std::uint64_t first = begin % length;
              const std::uint64_t here = std::min(count, length - first);
              parts[begin / length]->fill(first, here, place);
              begin += here;
              count -= here;
              place += here * element_size(type);
            }
          }};
}

Paths state_paths(const ResultContent& content) {
  Paths paths;
  for (const ResultAxis& axis : content.axes) {
    if (axis.is_state) paths.push_back("/" + axis.name);
  }
  return paths;
}

std::uint64_t cell_count(const ResultContent& content) {
  std::uint64_t cells = 1;
  for (const ResultAxis& axis : content.axes) cells *= axis.is_state ? axis.points.size() : 1;
  return cells;
}

Paths with(std::string first, const Paths& rest) {
  Paths paths{std::move(first)};
  paths.insert(paths.end(), rest.begin(), rest.end());
  return paths;
}

/// A plain number in UDUNITS: a count of steps must not look like a time, or xarray would make it one.
void describe(const hdf5::Handle& dataset, const std::string& long_name) {
  set_attribute(dataset, "long_name", long_name);
  set_attribute(dataset, "units", std::string("1"));
}

/// @param meanings one word a value, separated by blanks
void describe_flags(const hdf5::Handle& dataset, ElementType type, const std::vector<std::int64_t>& values,
                    const std::string& meanings) {
  set_attribute(dataset, "flag_values", type, values);
  set_attribute(dataset, "flag_meanings", meanings);
}

std::int64_t largest_value(ElementType type) {
  return type == ElementType::int16 ? std::numeric_limits<std::int16_t>::max()
                                    : std::numeric_limits<std::int32_t>::max();
}

void write_set(NetcdfWriter& file, const ResultContent& content, const std::string& name,
               const ResultArray& array, std::uint64_t cells, const std::string& long_name) {
  const hdf5::Handle dataset = file.add_array("/" + name, state_paths(content), array);
  describe(dataset, long_name);
  describe_flags(dataset, ElementType::uint8, {0, 1}, "not_" + name + " " + name);
  set_attribute(dataset, "cells", cells);
}

/// Delays or triggers of all partitions in one array.
ResultArray steps_array(const ResultContent& content, ResultArray ResultPartition::*member) {
  std::vector<const ResultArray*> parts;
  for (const ResultPartition& partition : content.partitions) parts.push_back(&(partition.*member));
  const ElementType type = parts.empty() ? ElementType::int16 : parts.front()->type;
  for (const ResultArray* part : parts) {
    if (part->type != type) throw std::invalid_argument("partitions with different element types");
  }
  return stacked(type, cell_count(content), parts);
}

ElementType steps_type(const ResultContent& content, ResultArray ResultPartition::*member) {
  return content.partitions.empty() ? ElementType::int16 : (content.partitions.front().*member).type;
}

std::size_t layer_count(const ResultContent& content) {
  std::size_t count = 1;
  for (const ResultPartition& partition : content.partitions) {
    count = std::max(count, partition.layer_sizes.size());
  }
  return count;
}

/// |Z_k| for k = 0, ..., count - 1; constant once fixed.
std::vector<std::uint64_t> padded_layer_sizes(const ResultPartition& partition, std::size_t count) {
  std::vector<std::uint64_t> sizes = partition.layer_sizes;
  sizes.resize(count, sizes.empty() ? 0 : sizes.back());
  return sizes;
}

void write_layer_lists(NetcdfWriter& file, const ResultPartition& partition) {
  const std::string group = "/layers/" + partition.name;
  const ResultLayers& layers = *partition.layers;
  file.add_dimension(group + "/bound", layers.start.size());
  file.add_dimension(group + "/position", layers.start.empty() ? 0 : layers.start.back());
  const hdf5::Handle start =
      file.add_array(group + "/start", {group + "/bound"}, array_of(ElementType::uint64, layers.start));
  describe(start, "layer T(k) is cell[start[k] : start[k+1]]");
  const hdf5::Handle cell = file.add_array(group + "/cell", {group + "/position"}, layers.cell);
  describe(cell, "row-major linear index of the cell, by layer, ascending");
}

hdf5::Handle write_bits(NetcdfWriter& file, const ResultContent& content, const std::string& path,
                        const ResultBits& bits, const std::string& long_name) {
  const std::string bytes = path + ":byte";
  file.add_dimension(bytes, bits.actions / 8 + (bits.actions % 8 != 0 ? 1 : 0));
  Paths dimensions = state_paths(content);
  dimensions.push_back(bytes);
  hdf5::Handle dataset = file.add_array(path, dimensions, {ElementType::uint8, bits.fill});
  describe(dataset, long_name);
  std::string inputs;
  for (const std::string& input : bits.inputs) inputs += (inputs.empty() ? "" : " ") + input;
  set_attribute(dataset, "inputs", inputs);
  set_attribute(dataset, "actions", bits.actions);
  set_attribute(dataset, "bitorder", std::string("little"));
  return dataset;
}

}  // namespace

void write_header(NetcdfWriter& file, const ResultContent& content) {
  const hdf5::Handle root = hdf5::open_object(file.file(), "/");
  set_attribute(root, "filetype", std::string(kResultsFiletype));
  set_attribute(root, "version", ElementType::int32, {kResultsVersion.begin(), kResultsVersion.end()});
  set_attribute(root, "coordreq_version", std::string(program_version()));
  set_attribute(root, "git_sha1", std::string(program_git_sha1()));
  set_attribute(root, "title", content.name);
  set_attribute(root, "Conventions", std::string("CF-1.10"));
  set_attribute(root, "spec_sha256", sha256_hex(content.spec_text));
  set_attribute(root, "period", content.period);
  set_attribute(root, "period_unit",
                content.period_unit.empty() ? std::string() : udunits_spelling(content.period_unit));
  set_attribute(root, "guarantee", content.guarantee);

  const hdf5::Handle spec = file.add_text("/spec", content.spec_text);
  set_attribute(spec, "long_name", std::string("problem spec as analysed"));
}

void write_axes(NetcdfWriter& file, const ResultContent& content) {
  for (const ResultAxis& axis : content.axes) {
    const hdf5::Handle dataset = file.add_coordinates("/" + axis.name, axis.points.size(),
                                                      array_of(ElementType::float64, axis.points));
    const std::string role = axis.is_state ? "state" : "input";
    set_attribute(dataset, "long_name", role + " " + axis.name);
    set_attribute(dataset, "units", udunits_spelling(axis.unit));
    if (axis.step) set_attribute(dataset, "step", *axis.step);
    set_attribute(dataset, "role", role);
  }
  Paths names;
  for (const ResultPartition& partition : content.partitions) names.push_back(partition.name);
  const hdf5::Handle partitions = file.add_coordinates("/partition", names);
  set_attribute(partitions, "long_name", std::string("partition of the agents into classes that coordinate"));

  std::vector<std::int32_t> numbers(layer_count(content));
  std::iota(numbers.begin(), numbers.end(), 0);
  const hdf5::Handle layers =
      file.add_coordinates("/layer", numbers.size(), array_of(ElementType::int32, numbers));
  describe(layers, "number k of the layer");
}

void write_sets(NetcdfWriter& file, const ResultContent& content) {
  write_set(file, content, "safe", content.safe, content.safe_cells, "cell is in the safe set S");
  write_set(file, content, "invariant", content.invariant, content.invariant_cells,
            "cell is in the invariance set K");

  const ElementType type = content.collision_time.type;
  const hdf5::Handle times = file.add_array("/collision_time", state_paths(content), content.collision_time);
  describe(times, "steps within which the worst case leaves the safe set, whatever is coordinated");
  describe_flags(times, type, {0, largest_value(type)}, "not_safe never");
  set_attribute(times, "iterations", content.iterations);
}

void write_delays(NetcdfWriter& file, const ResultContent& content) {
  const Paths dimensions = with("/partition", state_paths(content));
  const hdf5::Handle delay =
      file.add_array("/delay", dimensions, steps_array(content, &ResultPartition::delay));
  const ElementType delay_type = steps_type(content, &ResultPartition::delay);
  describe(delay, "largest number of steps without coordination that keeps the system safe");
  describe_flags(delay, delay_type, {-2, -1, largest_value(delay_type)}, "not_safe not_invariant unbounded");

  const ResultArray triggers = steps_array(content, &ResultPartition::trigger);
  const hdf5::Handle trigger = content.triggers_are_delays
                                   ? file.add_copy("/trigger", dimensions, triggers, delay)
                                   : file.add_array("/trigger", dimensions, triggers);
  const ElementType trigger_type = steps_type(content, &ResultPartition::trigger);
  describe(trigger, "steps until the agents must start to connect");
  describe_flags(trigger, trigger_type, {-3, -2, -1, largest_value(trigger_type)},
                 "connection_must_stand_already not_safe not_invariant never");
  set_attribute(trigger, "connection_delay", content.connection_delay);
}

void write_layers(NetcdfWriter& file, const ResultContent& content) {
  const std::size_t layers = layer_count(content);
  std::vector<std::uint64_t> sizes;
  std::vector<std::int32_t> fixed_points;
  for (const ResultPartition& partition : content.partitions) {
    const std::vector<std::uint64_t> row = padded_layer_sizes(partition, layers);
    sizes.insert(sizes.end(), row.begin(), row.end());
    fixed_points.push_back(partition.fixed_point_index);
  }
  const hdf5::Handle size =
      file.add_array("/layer_size", {"/partition", "/layer"}, array_of(ElementType::uint64, sizes));
  describe(size, "number of cells in Z_k");
  const hdf5::Handle index =
      file.add_array("/fixed_point_index", {"/partition"}, array_of(ElementType::int32, fixed_points));
  describe(index, "F, the first k with Z_k = Z_(k+1)");
  describe_flags(index, ElementType::int32, {-1}, "unknown_because_truncated");

  for (const ResultPartition& partition : content.partitions) {
    if (partition.layers) write_layer_lists(file, partition);
  }
}

void write_actions(NetcdfWriter& file, const ResultContent& content) {
  for (const ResultPartition& partition : content.partitions) {
    for (const ResultBits& bits : partition.actions) {
      write_bits(file, content, "/actions/" + partition.name + "/" + bits.class_name, bits,
                 "admissible joint actions of the class, one bit each");
    }
  }
  for (const ResultBits& bits : content.convention) {
    write_bits(
        file, content, paths::convention(bits.class_name), bits,
        "actions that the agent may take by convention, whatever the others do of theirs, one bit each");
  }
  if (content.controller) {
    write_bits(file, content, "/controller", *content.controller,
               "joint inputs that the controller admits, one bit each");
  }
  if (content.listed) {
    const hdf5::Handle listed = write_bits(file, content, paths::kListed, *content.listed,
                                           "joint inputs that the controller file lists, one bit each");
    set_attribute(listed, "sha256", content.listed_sha256);
  }
}

void write_abstraction(NetcdfWriter& file, const ResultContent& content) {
  for (const ResultTable& table : content.abstraction) {
    Paths dimensions;
    for (const std::string& name : table.depends_on) dimensions.push_back("/" + name);
    const std::string group = "/abstraction/" + table.state;
    const hdf5::Handle first =
        file.add_array(group + "/first", dimensions, array_of(ElementType::int32, table.first));
    describe(first, "smallest grid index that " + table.state + " can have next");
    const hdf5::Handle last =
        file.add_array(group + "/last", dimensions, array_of(ElementType::int32, table.last));
    describe(last, "largest grid index that " + table.state + " can have next");
  }
}

void write_maps(NetcdfWriter& file, const ResultContent& content) {
  for (const ResultNames& axis : content.names) {
    const hdf5::Handle dataset = file.add_coordinates("/" + axis.name, axis.names);
    set_attribute(dataset, "long_name", axis.long_name);
  }
  for (const ResultMap& map : content.maps) {
    const Paths cells = state_paths(content);
    const hdf5::Handle dataset = file.add_array(
        "/" + map.name, map.leading.empty() ? cells : with("/" + map.leading, cells), map.values);
    describe(dataset, map.long_name);
    for (const auto& [name, value] : map.integers) set_attribute(dataset, name, value);
    if (!map.cells.empty() && map.cells.size() <= kMostCounted)
      set_attribute(dataset, "cells", ElementType::uint64, map.cells);
    if (map.flags.empty()) continue;
    std::vector<std::int64_t> values;
    std::string meanings;
    for (const auto& [value, meaning] : map.flags) {
      values.push_back(value);
      meanings += (meanings.empty() ? "" : " ") + meaning;
    }
    describe_flags(dataset, map.values.type, values, meanings);
  }
}

}  // namespace coordreq
