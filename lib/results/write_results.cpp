#include "results/write_results.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "answers/field_parts.hpp"
#include "answers/field_table.hpp"
#include "results/hdf5_handle.hpp"
#include "results/netcdf_writer.hpp"
#include "results/output_file.hpp"
#include "results/version.hpp"
#include "spec/problem_spec.hpp"
#include "spec/set_value.hpp"

namespace coordreq {
namespace {

std::int64_t largest_value(ElementType type) {
  switch (type) {
    case ElementType::uint8:
      return std::numeric_limits<std::uint8_t>::max();
    case ElementType::int16:
      return std::numeric_limits<std::int16_t>::max();
    default:
      return std::numeric_limits<std::int32_t>::max();
  }
}

/// Writes one attribute, or two for flags.
class AttributeWriter {
 public:
  /// @param type of the elements of the object
  AttributeWriter(const hdf5::Handle& object, ElementType type) : object_(object), type_(type) {}

  void write(const std::string& name, const AttributeValue& value) {
    std::visit([&](const auto& one) { set(name, one); }, value);
  }

 private:
  template <class Value>
  void set(const std::string& name, const Value& value) {
    hdf5::set_attribute(object_, name, value);
  }
  void set(const std::string& name, const std::vector<std::uint64_t>& values) {
    hdf5::set_attribute(object_, name, ElementType::uint64, {values.begin(), values.end()});
  }
  void set(const std::string& /*name*/, const std::vector<FieldFlag>& flags) {
    std::vector<std::int64_t> values;
    std::string text;
    for (const FieldFlag& flag : flags) {
      values.push_back(flag.value == kLargestValue ? largest_value(type_) : flag.value);
      text += (text.empty() ? "" : " ") + flag.meaning;
    }
    hdf5::set_attribute(object_, "flag_values", type_, values);
    hdf5::set_attribute(object_, "flag_meanings", text);
  }

  const hdf5::Handle& object_;
  ElementType type_;
};

ResultArray numbers(Numbers scale) {
  return {ElementType::int32, [scale](std::uint64_t begin, std::uint64_t count, void* out) {
            auto* const first = static_cast<std::int32_t*>(out);
            std::iota(first, first + count, scale.first + static_cast<std::int32_t>(begin));
          }};
}

ResultArray points(const GridPoints& grid) {
  return {ElementType::float64, [&grid](std::uint64_t begin, std::uint64_t count, void* out) {
            auto* const values = static_cast<double*>(out);
            for (std::uint64_t i = 0; i < count; ++i) values[i] = grid.at(begin + i);
          }};
}

/// The length of the scale of a field; nothing if the file does not have it. @throws std::invalid_argument if
/// no length was found
std::optional<std::uint64_t> length_of(const Field& field, const FieldValues& values) {
  const FieldScale& scale = *field.scale;
  const auto found = values.lengths.find(field.path);
  if (found != values.lengths.end()) return found->second;
  if (scale.is_optional) return std::nullopt;
  if (scale.least != scale.most) throw std::invalid_argument("no length of " + field.path);
  return scale.least;
}

/// The values found for a field. @throws std::invalid_argument if there are none, or of another type
const FieldValues::Entry& entry_of(const Field& field, const FieldValues& values) {
  const auto found = values.entries.find(field.path);
  if (found == values.entries.end()) throw std::invalid_argument("no values of " + field.path);
  if (std::find(field.types.begin(), field.types.end(), found->second.array.type) == field.types.end())
    throw std::invalid_argument("values of another type than " + field.path + " has");
  return found->second;
}

/// Elements of a field for each cell, 0 if it is not by all cells. @param shape of the field
std::uint64_t elements_of_cell(const Field& field, const ProblemSpec& spec,
                               const std::vector<std::uint64_t>& shape) {
  const std::vector<std::string> cells = cell_axes(spec);
  const auto found = std::search(field.axes.begin(), field.axes.end(), cells.begin(), cells.end());
  if (found == field.axes.end()) return 0;
  return std::accumulate(
      shape.begin() + (found - field.axes.begin()) + static_cast<std::ptrdiff_t>(cells.size()), shape.end(),
      std::uint64_t{1}, std::multiplies<>());
}

class FieldsWriter {
 public:
  /// @param ranks who knows arrays of cells, if there are several processes; else null
  FieldsWriter(const std::string& path, const FieldValues& values, ThreadTeam& team, RankChunks* ranks)
      : file_(path, team, ranks), values_(values), has_ranks_(ranks != nullptr) {}

  void write(const FileKind& kind, const std::vector<FieldAttribute>& attributes, const ProblemSpec& spec,
             const Fields& fields) {
    write_header(kind, attributes, spec);
    for (const Field& field : fields) field.scale ? write_scale(field) : write_array(field, spec);
    file_.finish();
  }

 private:
  void write_header(const FileKind& kind, const std::vector<FieldAttribute>& attributes,
                    const ProblemSpec& spec) {
    const hdf5::Handle root = hdf5::open_object(file_.file(), "/");
    hdf5::set_attribute(root, "filetype", kind.filetype);
    hdf5::set_attribute(root, "version", ElementType::int32, {kind.version.begin(), kind.version.end()});
    for (const FieldAttribute& attribute : attributes)
      AttributeWriter(root, ElementType::int32).write(attribute.name, attribute.value);
    const hdf5::Handle text = file_.add_text("/spec", spec.text);
    hdf5::set_attribute(text, "long_name", std::string("problem spec as analysed"));
    const hdf5::Handle json = file_.add_text("/spec_json", without_comments(spec.text));
    hdf5::set_attribute(json, "long_name", std::string("the same as JSON, without comments"));
  }

  void write_scale(const Field& field) {
    const FieldScale& scale = *field.scale;
    const std::optional<std::uint64_t> length = length_of(field, values_);
    if (!length) return;
    lengths_[field.path] = *length;
    if (std::holds_alternative<NoCoordinates>(scale.coordinates))
      return file_.add_dimension(field.path, *length);
    const hdf5::Handle dataset = add_coordinates(field.path, *length, scale);
    write_attributes(field, dataset, field.types.empty() ? ElementType::int32 : field.types.front(), nullptr);
  }

  hdf5::Handle add_coordinates(const std::string& path, std::uint64_t length, const FieldScale& scale) {
    if (const auto* names = std::get_if<std::vector<std::string>>(&scale.coordinates))
      return file_.add_coordinates(path, *names);
    const auto* const grid = std::get_if<GridPoints>(&scale.coordinates);
    return file_.add_coordinates(
        path, length, grid != nullptr ? points(*grid) : numbers(std::get<Numbers>(scale.coordinates)));
  }

  void write_array(const Field& field, const ProblemSpec& spec) {
    const auto shape = shape_of(field, lengths_);
    if (!shape) return;
    const FieldValues::Entry& entry = entry_of(field, values_);
    const ElementType type = entry.array.type;
    ResultArray array = entry.array;
    array.of_cell = has_ranks_ ? elements_of_cell(field, spec, *shape) : 0;
    const hdf5::Handle dataset =
        entry.equals.empty()
            ? file_.add_array(field.path, field.axes, array)
            : file_.add_copy(field.path, field.axes, array, hdf5::open_object(file_.file(), entry.equals));
    write_attributes(field, dataset, type, &entry);
  }

  /// @param entry with what is found; none for scales
  static void write_attributes(const Field& field, const hdf5::Handle& dataset, ElementType type,
                               const FieldValues::Entry* entry) {
    AttributeWriter writer(dataset, type);
    for (const FieldAttribute& attribute : field.attributes) {
      const bool is_computed = attribute.is_computed && entry != nullptr;
      writer.write(attribute.name, is_computed ? entry->attributes.at(attribute.name) : attribute.value);
    }
  }

  NetcdfWriter file_;
  const FieldValues& values_;
  bool has_ranks_;
  std::map<std::string, std::uint64_t> lengths_;
};

/// The work of all ranks but the first, while the first one writes the fields.
void send_chunks(const ProblemSpec& spec, const Fields& fields, const FieldValues& values,
                 RankChunks& ranks) {
  std::map<std::string, std::uint64_t> lengths;
  for (const Field& field : fields) {
    if (field.scale) {
      if (const auto length = length_of(field, values)) lengths[field.path] = *length;
      continue;
    }
    const auto shape = shape_of(field, lengths);
    if (!shape) continue;
    const FieldValues::Entry& entry = entry_of(field, values);
    ResultArray array = entry.array;
    array.of_cell = elements_of_cell(field, spec, *shape);
    const ChunkLayout layout(*shape, element_size(array.type));
    const bool is_copied = !entry.equals.empty() && layout.chunked();
    if (!array.is_divided() || is_copied) continue;
    ranks.pack(layout, array);
    ranks.send_packed();
  }
}

}  // namespace

void write_results(const std::string& path, const ProblemSpec& spec, const FieldValues& values,
                   ThreadTeam& team, RankChunks* ranks) {
  const Fields fields = result_fields(spec);
  if (ranks != nullptr && !ranks->is_first()) return send_chunks(spec, fields, values, *ranks);
  const FileKind kind{
      .label = "the results", .filetype = std::string(kResultsFiletype), .version = kResultsVersion};
  write_fields(path, kind, header_attributes(spec), spec, fields, values, team, ranks);
}

void write_fields(const std::string& path, const FileKind& kind,
                  const std::vector<FieldAttribute>& attributes, const ProblemSpec& spec,
                  const Fields& fields, const FieldValues& values, ThreadTeam& team, RankChunks* ranks) {
  hdf5::expect_memory();
  write_whole_file(path, kind.label, [&](const std::string& temporary) {
    FieldsWriter(temporary, values, team, ranks).write(kind, attributes, spec, fields);
  });
}

double write_results_bytes(const ProblemSpec& spec, double longest, int threads) {
  constexpr double kCopiesOfText = 6;              // three that HDF5 asks for, and those of /spec_json
  constexpr double kBytesOfDataset = 22.0 * 1024;  // what the library keeps of one
  const Fields fields = result_fields(spec);
  const auto datasets = static_cast<double>(std::ranges::count_if(
      fields, [](const Field& field) { return !field.path.starts_with("/counterexample"); }));
  return kBytesOfDataset * datasets + ArrayWriter::bytes(longest, threads) +
         kCopiesOfText * static_cast<double>(spec.text.size());
}

void check_writable(const std::string& path) {
  const OutputFile probe(path);
}

}  // namespace coordreq
