#include "results/check_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "answers/field_table.hpp"
#include "base/error.hpp"
#include "base/process_memory.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Lengths = std::map<std::string, std::uint64_t>;

class FieldChecker {
 public:
  FieldChecker(const ResultsFile& file, const ProblemSpec& spec) : file_(file) {
    for (const StateSpec& state : spec.states) cell_axes_.push_back("/" + state.name);
  }

  Fields run(const Fields& table, std::optional<std::uint64_t> max_memory) {
    expect_memory("the datasets in the file need", kBytesOfDataset * datasets(table), max_memory);
    Fields present;
    for (const Field& field : table) {
      if (field.scale ? check_scale(field) : check_array(field)) present.push_back(field);
    }
    expect_memory("the lists in the file need", static_cast<double>(bytes_), max_memory);
    for (const Field& field : present) {
      if (field.scale) check_coordinates(field);
    }
    return present;
  }

 private:
  /// Memory of the library for an open dataset.
  static constexpr double kBytesOfDataset = 24.0 * 1024;

  [[nodiscard]] double datasets(const Fields& table) const {
    return static_cast<double>(
        std::ranges::count_if(table, [this](const Field& field) { return file_.exists(field.path); }));
  }

  [[noreturn]] void fail(const std::string& what, const Field& field) const {
    throw ResultsError(what, file_.location(field.path));
  }

  /// Its length and type. @returns whether it is there
  bool check_scale(const Field& field) {
    const FieldScale& scale = *field.scale;
    if (scale.is_optional && !file_.exists(field.path)) return false;
    if (scale.least == scale.most) file_.expect_shape(field.path, {scale.least});
    const std::vector<std::uint64_t> shape = file_.shape(field.path);
    if (shape.size() != 1) fail("not a list", field);
    const std::uint64_t length = shape.front();
    if (length < scale.least || length > scale.most)
      fail(fmt::format("found {} entries, expected {} to {}", length, scale.least, scale.most), field);
    lengths_[field.path] = length;
    if (std::holds_alternative<NoCoordinates>(scale.coordinates)) return true;
    file_.expect_array(field.path, field.types, shape);
    if (!std::holds_alternative<GridPoints>(scale.coordinates)) count_bytes(length);
    return true;
  }

  bool check_array(const Field& field) {
    const auto shape = shape_of(field, lengths_);
    if (!shape) return false;
    file_.expect_array(field.path, field.types, *shape);
    for (const FieldAttribute& attribute : field.attributes) check_count(field, attribute);
    if (!is_by_cell(field)) {
      std::uint64_t elements = 1;
      for (const std::uint64_t length : *shape) elements *= length;
      count_bytes(elements);
    }
    return true;
  }

  /// A count that the spec fixes has to be that one.
  void check_count(const Field& field, const FieldAttribute& attribute) const {
    const auto* const expected = std::get_if<std::uint64_t>(&attribute.value);
    if (expected == nullptr || attribute.is_computed) return;
    const std::int64_t found = file_.integer(field.path, attribute.name);
    if (found == static_cast<std::int64_t>(*expected)) return;
    fail(fmt::format("the attribute {} is {}, expected {}", attribute.name, found, *expected), field);
  }

  [[nodiscard]] bool is_by_cell(const Field& field) const {
    return std::search(field.axes.begin(), field.axes.end(), cell_axes_.begin(), cell_axes_.end()) !=
           field.axes.end();
  }

  /// Counts a dataset that is read: eight bytes an element as read, as stored, and as a copy of another type.
  void count_bytes(std::uint64_t elements) { bytes_ += elements * 24; }

  void check_coordinates(const Field& field) const {
    const FieldScale& scale = *field.scale;
    const std::uint64_t length = lengths_.at(field.path);
    if (const auto* names = std::get_if<std::vector<std::string>>(&scale.coordinates)) {
      if (file_.texts(field.path) != *names) fail("the names are not those of the spec", field);
    } else if (const auto* points = std::get_if<GridPoints>(&scale.coordinates)) {
      check_points(field, *points, length);
    } else if (const auto* counted = std::get_if<Numbers>(&scale.coordinates)) {
      const std::vector<std::int64_t> numbers = file_.integers(field.path);
      for (std::size_t k = 0; k < numbers.size(); ++k) {
        if (numbers[k] == counted->first + static_cast<std::int64_t>(k)) continue;
        fail(fmt::format("not the numbers {}, {}, ...", counted->first, counted->first + 1), field);
      }
    }
  }

  void check_points(const Field& field, const GridPoints& points, std::uint64_t length) const {
    constexpr std::uint64_t kSegment = std::uint64_t{1} << 16U;
    for (std::uint64_t begin = 0; begin < length; begin += kSegment) {
      const std::vector<double> found = file_.numbers(field.path, begin, std::min(kSegment, length - begin));
      for (std::uint64_t k = 0; k < found.size(); ++k) {
        if (found[k] == points.at(begin + k)) continue;
        fail("grid point " + std::to_string(begin + k) + " is not that of the spec", field);
      }
    }
  }

  const ResultsFile& file_;
  std::vector<std::string> cell_axes_;
  Lengths lengths_;
  std::uint64_t bytes_ = 0;
};

}  // namespace

Fields checked_fields(const ResultsFile& file, const ProblemSpec& spec,
                      std::optional<std::uint64_t> max_memory) {
  return FieldChecker(file, spec).run(result_fields(spec), max_memory);
}

const Field* SmallFields::find(const std::string& path) const {
  const auto field = std::find_if(metadata_.fields.begin(), metadata_.fields.end(),
                                  [&path](const Field& one) { return one.path == path; });
  return field == metadata_.fields.end() ? nullptr : &*field;
}

bool SmallFields::has(const std::string& path) const {
  return find(path) != nullptr;
}

std::vector<std::int64_t> SmallFields::integers(const std::string& path) const {
  std::vector<std::int64_t> values = file_.integers(path);
  const Field* const field = find(path);
  for (const std::int64_t value : values) {
    if (field == nullptr || (value >= field->least && value <= field->most)) continue;
    fail("found " + std::to_string(value) + ", which is none of its values", path);
  }
  return values;
}

std::vector<double> SmallFields::numbers(const std::string& path) const {
  return file_.numbers(path);
}

std::vector<std::uint64_t> SmallFields::list(const std::string& path) const {
  return file_.naturals(path);
}

std::vector<std::uint64_t> SmallFields::counted(const std::string& path) const {
  const auto found = metadata_.counted.find(path);
  return found == metadata_.counted.end() ? std::vector<std::uint64_t>() : found->second;
}

std::int64_t SmallFields::attribute(const std::string& path, const std::string& name) const {
  return file_.integer(path, name);
}

double SmallFields::number(const std::string& path, const std::string& name) const {
  return file_.number(path, name);
}

void SmallFields::expect_length(const std::string& path, std::uint64_t length) const {
  file_.expect_shape(path, {length});
}

void SmallFields::fail(const std::string& what, const std::string& path) const {
  throw ResultsError(what, file_.location(path));
}

}  // namespace coordreq
