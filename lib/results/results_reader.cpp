#include "results/results_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "answers/coalition/fields.hpp"
#include "answers/convention/fields.hpp"
#include "answers/invariance/fields.hpp"
#include "answers/layers/fields.hpp"
#include "answers/network/fields.hpp"
#include "base/error.hpp"
#include "results/check_fields.hpp"
#include "results/child_trial.hpp"
#include "results/reading.hpp"
#include "results/results_file.hpp"

namespace coordreq {
namespace {

std::vector<std::uint64_t> unsigned_of(const std::vector<std::int64_t>& values) {
  return {values.begin(), values.end()};
}

/// A block of cells in an array over cells.
struct Part {
  /// @param leading place along an axis before those of the cells, if there is one
  Part(std::optional<std::size_t> leading, const CellBlock& block)
      : offset(unsigned_of(block.first)), count(unsigned_of(block.count)) {
    if (!leading) return;
    offset.insert(offset.begin(), *leading);
    count.insert(count.begin(), 1);
  }
  std::vector<std::uint64_t> offset;
  std::vector<std::uint64_t> count;
};

/// `values` with the type's largest value, which stands for infinity, as kNever.
template <class Integer>
std::vector<std::int32_t> widened(const std::vector<Integer>& values) {
  std::vector<std::int32_t> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(), [](Integer value) {
    return value == std::numeric_limits<Integer>::max() ? ResultsReader::kNever : std::int32_t{value};
  });
  return result;
}

/// Of unpacked chunks.
std::size_t cache_bytes(std::optional<std::uint64_t> max_memory) {
  constexpr std::uint64_t kMost = std::uint64_t{128} << 20U;
  return static_cast<std::size_t>(std::min(kMost, max_memory.value_or(kMost) / 4));
}

/// The file, which has been read in a child process.
std::unique_ptr<ResultsFile> tried_file(const std::string& path, std::optional<std::uint64_t> max_memory) {
  const auto open = [&] { return std::make_unique<ResultsFile>(path, cache_bytes(max_memory)); };
  try_in_child(path, [&] { reading(path, [&] { static_cast<void>(read_parts(*open(), max_memory)); }); });
  return reading(path, open);
}

}  // namespace

ResultsReader::ResultsReader(const std::string& path, std::optional<std::uint64_t> max_memory)
    : path_(path),
      max_memory_(max_memory),
      file_(tried_file(path, max_memory)),
      parts_(reading(path, [&] { return read_parts(*file_, max_memory); })),
      grid_(make_grid(parts_.spec)),
      inputs_(make_input_space(parts_.spec)) {
  for (std::size_t i = 0; i < parts_.fields.size(); ++i) field_of_path_[parts_.fields[i].path] = i;
  for (const Field& field : parts_.fields) {
    if (!field.fixed_points.empty()) fixed_points_[field.fixed_points] = integers(field.fixed_points);
  }
}

ResultsReader::~ResultsReader() = default;

template <class Value>
std::vector<Value> ResultsReader::elements(const std::string& dataset, ElementType type,
                                           const std::vector<std::uint64_t>& offset,
                                           const std::vector<std::uint64_t>& count) const {
  std::uint64_t product = 1;
  for (const std::uint64_t length : count) product *= length;
  if (max_memory_ && product > *max_memory_ / sizeof(Value)) {
    throw LimitError(fmt::format("reading needs about {} MiB of memory, the limit is {} MiB",
                                 product * sizeof(Value) >> 20U, *max_memory_ >> 20U),
                     file_->place(dataset));
  }
  std::vector<Value> values(product);
  if (product == 0) return values;
  reading(path_, [&] { file_->read_block(dataset, type, offset, count, values.data()); });
  return values;
}

const Field& ResultsReader::field(const std::string& path) const {
  return parts_.fields[field_of_path_.at(path)];
}

std::size_t ResultsReader::leading_length(const Field& field) const {
  return field.axes.size() > grid_.size() ? leading_names(field).size() : 0;
}

const std::vector<std::string>& ResultsReader::leading_names(const Field& field) const {
  return std::get<std::vector<std::string>>(this->field(field.axes.front()).scale->coordinates);
}

std::optional<std::int64_t> ResultsReader::lower_bound(const Field& field, std::size_t partition) const {
  if (field.fixed_points.empty() || fixed_points_.at(field.fixed_points)[partition] >= 0) return std::nullopt;
  return parts_.spec.coordination.max_delay;
}

std::vector<std::uint8_t> ResultsReader::members(const Field& field, std::optional<std::size_t> leading,
                                                 const CellBlock& block) const {
  const Part part(leading, block);
  std::vector<std::uint8_t> values =
      elements<std::uint8_t>(field.path, ElementType::uint8, part.offset, part.count);
  if (std::any_of(values.begin(), values.end(), [](std::uint8_t value) { return value > 1; })) {
    throw ResultsError("a value other than 0 and 1: damaged", file_->place(field.path));
  }
  return values;
}

std::vector<std::int32_t> ResultsReader::values(const Field& field, std::optional<std::size_t> leading,
                                                const CellBlock& block) const {
  const Part part(leading, block);
  const ElementType type = reading(path_, [&] { return file_->element_type(field.path); });
  if (type == ElementType::uint8) {
    const std::vector<std::uint8_t> found = members(field, leading, block);
    return {found.begin(), found.end()};
  }
  const std::vector<std::int32_t> values =
      type == ElementType::int16 ? widened(elements<std::int16_t>(field.path, type, part.offset, part.count))
                                 : widened(elements<std::int32_t>(field.path, type, part.offset, part.count));
  for (const std::int32_t value : values) {
    if (value >= field.least && value <= field.most) continue;
    throw ResultsError(value < field.least ? fmt::format("found {}, expected at least {}", value, field.least)
                                           : fmt::format("found {}, expected at most {}", value, field.most),
                       file_->place(field.path));
  }
  return values;
}

std::vector<float> ResultsReader::shares(const Field& field, std::optional<std::size_t> leading,
                                         const CellBlock& block) const {
  const Part part(leading, block);
  return elements<float>(field.path, ElementType::float32, part.offset, part.count);
}

std::vector<std::int64_t> ResultsReader::integers(const std::string& path) const {
  return reading(path_, [&] { return SmallFields(*file_, parts_).integers(path); });
}

std::vector<double> ResultsReader::numbers(const std::string& path) const {
  return reading(path_, [&] { return SmallFields(*file_, parts_).numbers(path); });
}

std::int64_t ResultsReader::attribute(const std::string& path, const std::string& name) const {
  return SmallFields(*file_, parts_).attribute(path, name);
}

std::vector<std::uint64_t> ResultsReader::counted(const std::string& path) const {
  return SmallFields(*file_, parts_).counted(path);
}

void ResultsReader::fail(const std::string& what, const std::string& path) const {
  throw ResultsError(what, file_->place(path));
}

std::vector<std::string> ResultsReader::datasets() const {
  const auto list = [this] { return reading(path_, [this] { return file_->datasets(); }); };
  try_in_child(path_, [&list] { static_cast<void>(list()); });
  return list();
}

std::vector<std::uint8_t> ResultsReader::safe(const CellBlock& block) const {
  return members(field("/safe"), std::nullopt, block);
}

std::vector<std::uint8_t> ResultsReader::invariant(const CellBlock& block) const {
  return members(field("/invariant"), std::nullopt, block);
}

std::vector<std::uint8_t> ResultsReader::network_safe(std::size_t first, std::size_t modes,
                                                      const CellBlock& block) const {
  std::vector<std::uint8_t> result;
  for (std::size_t mode = first; mode < first + modes; ++mode) {
    const std::vector<std::uint8_t> cells = members(field(paths::kNetworkSafe), mode, block);
    result.insert(result.end(), cells.begin(), cells.end());
  }
  return result;
}

std::vector<std::int32_t> ResultsReader::collision_time(const CellBlock& block) const {
  return values(field("/collision_time"), std::nullopt, block);
}

std::vector<std::int32_t> ResultsReader::delay(std::size_t partition, const CellBlock& block) const {
  return values(field("/delay"), partition, block);
}

std::vector<std::int32_t> ResultsReader::trigger(std::size_t partition, const CellBlock& block) const {
  return values(field("/trigger"), partition, block);
}

std::vector<std::int32_t> ResultsReader::coalition(const CellBlock& block) const {
  return values(field(paths::kCoalition), std::nullopt, block);
}

std::vector<std::uint8_t> ResultsReader::critical_pair(std::size_t pair, const CellBlock& block) const {
  return members(field(paths::kCriticalPair), pair, block);
}

bool ResultsReader::has_actions(std::size_t /*partition*/) const {
  return parts_.spec.output.actions;
}

bool ResultsReader::has_controller() const {
  return parts_.spec.output.controller;
}

bool ResultsReader::has_layers(std::size_t /*partition*/) const {
  return parts_.spec.output.layers;
}

bool ResultsReader::has_abstraction() const {
  return !parts_.tables.empty();
}

std::vector<std::uint8_t> ResultsReader::bits(const std::string& dataset, std::int64_t actions,
                                              const CellBlock& block) const {
  std::vector<std::uint64_t> offset = unsigned_of(block.first);
  std::vector<std::uint64_t> count = unsigned_of(block.count);
  offset.push_back(0);
  count.push_back(static_cast<std::uint64_t>((actions + 7) / 8));
  return elements<std::uint8_t>(dataset, ElementType::uint8, offset, count);
}

std::vector<std::uint8_t> ResultsReader::packed(const Field& own, const CellBlock& block) const {
  const std::uint64_t bytes = field(own.axes.back()).scale->most;
  return bits(own.path, static_cast<std::int64_t>(bytes) * 8, block);
}

std::vector<std::uint8_t> ResultsReader::action_bits(std::size_t partition, std::size_t class_number,
                                                     const CellBlock& block) const {
  return bits(paths::actions(parts_.spec, parts_.spec.coordination.partitions[partition], class_number),
              parts_.partitions[partition].actions[class_number], block);
}

std::vector<std::uint8_t> ResultsReader::controller_bits(const CellBlock& block) const {
  return bits(paths::kController, inputs_.count(), block);
}

std::vector<std::uint8_t> ResultsReader::listed_bits(const CellBlock& block) const {
  return bits(paths::kListed, inputs_.count(), block);
}

bool ResultsReader::has_convention() const {
  return parts_.spec.coordination.convention && parts_.spec.output.actions;
}

std::vector<std::uint8_t> ResultsReader::convention_bits(std::size_t agent, const CellBlock& block) const {
  const AgentSpec& spec = parts_.spec.agents[agent];
  std::int64_t actions = 1;
  for (const std::int32_t input : spec.inputs) actions *= inputs_[static_cast<std::size_t>(input)].count();
  return bits(paths::convention(spec), actions, block);
}

std::vector<std::uint64_t> ResultsReader::whole(const std::string& dataset) const {
  const auto shape = reading(path_, [&] { return file_->shape(dataset); });
  const auto type = reading(path_, [&] { return file_->element_type(dataset); });
  const std::vector<std::uint64_t> origin(shape.size(), 0);
  if (type == ElementType::uint64) return elements<std::uint64_t>(dataset, type, origin, shape);
  const std::vector<std::uint32_t> values = elements<std::uint32_t>(dataset, type, origin, shape);
  return {values.begin(), values.end()};
}

StoredLayers ResultsReader::layers(std::size_t partition) const {
  const std::string path = paths::layers(parts_.spec.coordination.partitions[partition]);
  StoredLayers layers{whole(path + "/start"), whole(path + "/cell")};
  if (!std::is_sorted(layers.start.begin(), layers.start.end()) || layers.start.front() != 0 ||
      layers.start.back() != layers.cell.size()) {
    throw ResultsError("does not ascend from 0 to the number of cells", file_->place(path + "/start"));
  }
  const auto cells = static_cast<std::uint64_t>(grid_.cells());
  if (std::any_of(layers.cell.begin(), layers.cell.end(), [&](std::uint64_t x) { return x >= cells; })) {
    throw ResultsError("a cell that the grid does not have", file_->place(path + "/cell"));
  }
  return layers;
}

Abstraction ResultsReader::abstraction() const {
  Abstraction abstraction{.grid = grid_, .inputs = inputs_, .tables = parts_.tables};
  for (std::size_t i = 0; i < abstraction.tables.size(); ++i) {
    TransitionTable& table = abstraction.tables[i];
    const auto entries = static_cast<std::size_t>(lay_out(table, i, grid_, inputs_));
    std::vector<std::uint64_t> shape;
    for (const std::int32_t j : table.states)
      shape.push_back(static_cast<std::uint64_t>(grid_[static_cast<std::size_t>(j)].count));
    for (const std::int32_t j : table.inputs)
      shape.push_back(static_cast<std::uint64_t>(inputs_[static_cast<std::size_t>(j)].count()));
    const std::vector<std::uint64_t> origin(shape.size(), 0);
    const std::string first_path = "/abstraction/" + grid_[i].name + "/first";
    const auto first = elements<std::int32_t>(first_path, ElementType::int32, origin, shape);
    const auto last =
        elements<std::int32_t>("/abstraction/" + grid_[i].name + "/last", ElementType::int32, origin, shape);
    for (std::size_t e = 0; e < entries; ++e) {
      if (first[e] > last[e]) throw ResultsError("an empty range of indices", file_->place(first_path));
      table.entries.push_back({first[e], last[e]});
    }
  }
  return abstraction;
}

}  // namespace coordreq
