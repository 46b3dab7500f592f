#include "results/results_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "answers/step_codes.hpp"
#include "base/error.hpp"
#include "base/process_memory.hpp"
#include "base/requires.hpp"
#include "results/check_fields.hpp"
#include "results/child_trial.hpp"
#include "results/reading.hpp"
#include "results/results_file.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

std::vector<std::uint64_t> unsigned_of(const std::vector<std::int64_t>& values) {
  return {values.begin(), values.end()};
}

/// A block of cells in an array of cells.
struct ArrayBox {
  /// @param leading position along an axis before those of the cells, if there is one
  ArrayBox(std::optional<std::size_t> leading, const CellBlock& block)
      : offset(unsigned_of(block.first)), count(unsigned_of(block.count)) {
    if (!leading) return;
    offset.insert(offset.begin(), *leading);
    count.insert(count.begin(), 1);
  }
  std::vector<std::uint64_t> offset;
  std::vector<std::uint64_t> count;
};

/// `values` with the type's largest value, which stands for infinity, as kUnbounded.
template <class Integer>
std::vector<std::int32_t> widened(const std::vector<Integer>& values) {
  std::vector<std::int32_t> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(), [](Integer value) {
    return value == std::numeric_limits<Integer>::max() ? kUnbounded : std::int32_t{value};
  });
  return result;
}

/// Memory for unpacked chunks: a fraction of the memory that is left.
std::size_t cache_bytes(std::optional<std::uint64_t> max_memory) {
  constexpr double kLeast = double{1U << 20U}, kMost = 128 * kLeast;
  if (!max_memory) return static_cast<std::size_t>(kMost);
  const double left = static_cast<double>(*max_memory) - memory_of_program();
  return static_cast<std::size_t>(std::clamp(left / 8, kLeast, kMost));
}

/// The file, which has been read in a child process.
std::unique_ptr<ResultsFile> tried_file(const std::string& path, std::optional<std::uint64_t> max_memory,
                                        std::size_t cache) {
  const auto open = [&] { return std::make_unique<ResultsFile>(path, cache); };
  try_in_child(path, [&] { reading(path, [&] { static_cast<void>(read_metadata(*open(), max_memory)); }); });
  return reading(path, open);
}

}  // namespace

ResultsReader::ResultsReader(const std::string& path, std::optional<std::uint64_t> max_memory)
    : path_(path),
      max_memory_(max_memory),
      cache_bytes_(cache_bytes(max_memory)),
      file_(tried_file(path, max_memory, cache_bytes_)),
      metadata_(reading(
          path, [&] { return std::make_unique<const ResultsMetadata>(read_metadata(*file_, max_memory)); })),
      grid_(make_grid(metadata_->spec)),
      inputs_(make_input_space(metadata_->spec)) {
  for (std::size_t i = 0; i < metadata_->fields.size(); ++i) field_of_path_[metadata_->fields[i].path] = i;
  for (const Field& field : metadata_->fields) {
    if (!field.fixed_points.empty()) fixed_points_[field.fixed_points] = integers(field.fixed_points);
  }
}

ResultsReader::~ResultsReader() = default;

const ProblemSpec& ResultsReader::spec() const {
  return metadata_->spec;
}

const StoredAttributes& ResultsReader::attributes() const {
  return metadata_->attributes;
}

const std::vector<StoredPartition>& ResultsReader::partitions() const {
  return metadata_->partitions;
}

const Fields& ResultsReader::fields() const {
  return metadata_->fields;
}

template <class Value>
std::vector<Value> ResultsReader::elements(const std::string& dataset, ElementType type,
                                           const std::vector<std::uint64_t>& offset,
                                           const std::vector<std::uint64_t>& count) const {
  std::uint64_t product = 1;
  for (const std::uint64_t length : count) product *= length;
  constexpr std::uint64_t kShort = std::uint64_t{1} << 18U;  // no matter
  if (product > kShort)
    expect_memory("reading needs", static_cast<double>(product) * sizeof(Value), max_memory_);
  std::vector<Value> values(product);
  if (product == 0) return values;
  reading(path_, [&] { file_->read_block(dataset, type, offset, count, values.data()); });
  return values;
}

const Field& ResultsReader::field(const std::string& path) const {
  REQUIRES(has(path));
  return metadata_->fields[field_of_path_.at(path)];
}

double ResultsReader::elements(const Field& field) const {
  double elements = 1;
  for (const std::uint64_t length : reading(path_, [&] { return file_->shape(field.path); }))
    elements *= static_cast<double>(length);
  return elements;
}

double ResultsReader::reading_bytes() const {
  constexpr double kBytesOfCell = 16;  // as it is stored, widened, and joined with others
  double stored = 0;
  for (const Field& field : metadata_->fields) {
    if (field.scale || field.types.empty()) continue;
    stored += elements(field) * static_cast<double>(element_size(file_->element_type(field.path)));
  }
  return std::min(stored, static_cast<double>(cache_bytes_)) +
         kBytesOfCell * static_cast<double>(std::min(grid_.cells(), kBlockCells));
}

std::size_t ResultsReader::leading_length(const Field& field) const {
  if (field.axes.size() <= grid_.size()) return 0;
  // A field of bits has one axis more, which comes last.
  const auto& first = this->field(field.axes.front()).scale->coordinates;
  const auto* const names = std::get_if<std::vector<std::string>>(&first);
  return names == nullptr ? 0 : names->size();
}

const std::vector<std::string>& ResultsReader::leading_names(const Field& field) const {
  const auto& names = this->field(field.axes.front()).scale->coordinates;
  REQUIRES(std::holds_alternative<std::vector<std::string>>(names));
  return std::get<std::vector<std::string>>(names);
}

std::optional<std::int64_t> ResultsReader::lower_bound(const Field& field, std::size_t partition) const {
  REQUIRES(partition < partitions().size());
  if (field.fixed_points.empty() || fixed_points_.at(field.fixed_points)[partition] >= 0) return std::nullopt;
  return metadata_->spec.coordination.max_delay;
}

std::vector<std::uint8_t> ResultsReader::members(const Field& field, Leading leading,
                                                 const CellBlock& block) const {
  const ArrayBox box(leading, block);
  std::vector<std::uint8_t> values =
      elements<std::uint8_t>(field.path, ElementType::uint8, box.offset, box.count);
  if (std::any_of(values.begin(), values.end(), [](std::uint8_t value) { return value > 1; })) {
    throw ResultsError("a value other than 0 and 1: damaged", file_->location(field.path));
  }
  return values;
}

std::vector<std::int32_t> ResultsReader::values(const Field& field, Leading leading,
                                                const CellBlock& block) const {
  if (field.kind == FieldKind::probability) {
    const std::vector<float> found = reals(field, leading, block);
    std::vector<std::int32_t> values(found.size());
    std::transform(found.begin(), found.end(), values.begin(),
                   [](float value) { return std::bit_cast<std::int32_t>(value); });
    return values;
  }
  const ArrayBox box(leading, block);
  const ElementType type = reading(path_, [&] { return file_->element_type(field.path); });
  if (type == ElementType::uint8) {
    const std::vector<std::uint8_t> found = members(field, leading, block);
    return {found.begin(), found.end()};
  }
  const std::vector<std::int32_t> values =
      type == ElementType::int16 ? widened(elements<std::int16_t>(field.path, type, box.offset, box.count))
                                 : widened(elements<std::int32_t>(field.path, type, box.offset, box.count));
  for (const std::int32_t value : values) {
    if (value >= field.least && value <= field.most) continue;
    throw ResultsError(value < field.least ? fmt::format("found {}, expected at least {}", value, field.least)
                                           : fmt::format("found {}, expected at most {}", value, field.most),
                       file_->location(field.path));
  }
  return values;
}

std::vector<float> ResultsReader::reals(const Field& field, Leading leading, const CellBlock& block) const {
  const ArrayBox box(leading, block);
  std::vector<float> values = elements<float>(field.path, ElementType::float32, box.offset, box.count);
  if (field.kind != FieldKind::probability) return values;
  // -0 is refused: as an integer it would be less than all others.
  const auto found = std::find_if(values.begin(), values.end(), [](float value) {
    return !(value >= 0 && value <= 1) || std::signbit(value);
  });
  if (found != values.end())
    throw ResultsError(fmt::format("found {}, expected a number from 0 to 1", *found),
                       file_->location(field.path));
  return values;
}

std::vector<std::int64_t> ResultsReader::integers(const std::string& path) const {
  return reading(path_, [&] { return SmallFields(*file_, *metadata_).integers(path); });
}

std::vector<double> ResultsReader::numbers(const std::string& path) const {
  return reading(path_, [&] { return SmallFields(*file_, *metadata_).numbers(path); });
}

std::vector<std::uint64_t> ResultsReader::list(const std::string& path) const {
  return reading(path_, [&] { return SmallFields(*file_, *metadata_).list(path); });
}

std::int64_t ResultsReader::attribute(const std::string& path, const std::string& name) const {
  return SmallFields(*file_, *metadata_).attribute(path, name);
}

double ResultsReader::number(const std::string& path, const std::string& name) const {
  return SmallFields(*file_, *metadata_).number(path, name);
}

std::vector<std::uint64_t> ResultsReader::counted(const std::string& path) const {
  return SmallFields(*file_, *metadata_).counted(path);
}

void ResultsReader::expect_length(const std::string& path, std::uint64_t length) const {
  reading(path_, [&] { SmallFields(*file_, *metadata_).expect_length(path, length); });
}

void ResultsReader::fail(const std::string& what, const std::string& path) const {
  throw ResultsError(what, file_->location(path));
}

std::vector<std::string> ResultsReader::datasets() const {
  const auto list = [this] { return reading(path_, [this] { return file_->datasets(); }); };
  try_in_child(path_, [&list] { static_cast<void>(list()); });
  return list();
}

std::vector<std::uint8_t> ResultsReader::bits(const Field& field, const CellBlock& block) const {
  ArrayBox box(std::nullopt, block);
  box.offset.push_back(0);
  box.count.push_back(this->field(field.axes.back()).scale->least);
  return elements<std::uint8_t>(field.path, ElementType::uint8, box.offset, box.count);
}

std::vector<std::uint8_t> ResultsReader::bytes(const Field& field,
                                               const std::vector<std::int64_t>& indices) const {
  std::vector<std::uint64_t> offset(indices.begin(), indices.end()), count(indices.size(), 1);
  offset.push_back(0);
  count.push_back(this->field(field.axes.back()).scale->least);
  return elements<std::uint8_t>(field.path, ElementType::uint8, offset, count);
}

std::vector<std::uint8_t> ResultsReader::bytes(const Field& field) const {
  const std::vector<std::uint64_t> shape = reading(path_, [&] { return file_->shape(field.path); });
  return elements<std::uint8_t>(field.path, ElementType::uint8, std::vector<std::uint64_t>(shape.size(), 0),
                                shape);
}

std::uint64_t ResultsReader::length(const std::string& scale) const {
  return reading(path_, [&] {
    REQUIRES(file_->exists(scale));
    return file_->shape(scale).front();
  });
}

bool ResultsReader::has_abstraction() const {
  return !metadata_->tables.empty();
}

Abstraction ResultsReader::abstraction() const {
  REQUIRES(has_abstraction());
  Abstraction abstraction{.grid = grid_, .inputs = inputs_, .tables = metadata_->tables};
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
      if (first[e] > last[e]) throw ResultsError("an empty range of indices", file_->location(first_path));
      table.entries.push_back({first[e], last[e]});
    }
  }
  return abstraction;
}

}  // namespace coordreq
