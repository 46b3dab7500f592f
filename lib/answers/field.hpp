#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/json.hpp"

// Datasets of the results file, each declared once: code that writes, reads, checks and shows the file goes
// over these declarations and knows no dataset by name.
namespace coordreq {

enum class ElementType : std::uint8_t { uint8, int16, int32, uint32, int64, uint64, float32, float64 };

[[nodiscard]] constexpr std::size_t element_size(ElementType type) {
  switch (type) {
    case ElementType::uint8:
      return 1;
    case ElementType::int16:
      return 2;
    case ElementType::int32:
    case ElementType::uint32:
    case ElementType::float32:
      return 4;
    case ElementType::int64:
    case ElementType::uint64:
    case ElementType::float64:
      break;
  }
  return 8;
}

/// Fills `out` with elements [begin, begin + count) of an array, row-major, in its element type.
/// Called from several threads at once.
using FillArray = std::function<void(std::uint64_t begin, std::uint64_t count, void* out)>;

/// Lists of cells, each ascending, one after the other; no cell is in two of them.
struct CellLists {
  static constexpr std::uint32_t kNone = UINT32_MAX;
  std::size_t count = 0;
  FillArray of_cell;  ///< uint32 [cells]: number of the list that the cell is in, or kNone
};

struct ResultArray {
  ElementType type = ElementType::uint8;
  FillArray fill;
  /// Number of elements for each cell, if each of several processes has the elements of its own cells; 0: it
  /// is no such array.
  std::uint64_t of_cell = 0;
  /// The lists, if the elements are lists of cells, which several processes make together.
  std::shared_ptr<const CellLists> lists = {};

  /// Each of several processes has a part of the array.
  [[nodiscard]] bool is_divided() const { return of_cell != 0 || lists != nullptr; }
};

/// A value with a meaning of its own; kLargestValue stands for the largest value of the type that the field
/// has.
struct FieldFlag {
  std::int64_t value = 0;
  std::string meaning;
};
inline constexpr std::int64_t kLargestValue = std::numeric_limits<std::int64_t>::max();

/// A list of uint64 is stored as a list; flags become the two attributes `flag_values`, of the type of the
/// field, and `flag_meanings`.
using AttributeValue = std::variant<std::string, double, std::int64_t, std::uint64_t,
                                    std::vector<std::uint64_t>, std::vector<FieldFlag>>;
struct FieldAttribute {
  std::string name;
  AttributeValue value;
  /// The analysis finds the value: `value` has the type alone, and of a list the length.
  bool is_computed = false;
};

/// The coordinates of an axis: none, so that it has a length alone; the numbers from `first` on; names; or
/// grid points, which are requested one by one, since there may be very many.
struct NoCoordinates {};
struct Numbers {
  std::int32_t first = 0;
};
struct GridPoints {
  std::function<double(std::uint64_t)> at;
};
struct FieldScale {
  std::variant<NoCoordinates, Numbers, std::vector<std::string>, GridPoints> coordinates;
  /// The length; different if it does not follow from the spec.
  std::uint64_t least = 0, most = 0;
  /// Whether the scale, and the fields over it, are in the file does not follow from the spec.
  bool is_optional = false;
};

/// The place of a field in the file: fields of a lower section are written first, those of one section in the
/// order of the answers.
enum class FieldSection : std::uint8_t {
  grid,
  axes,
  sets,
  steps,
  layers,
  layer_lists,
  actions,
  convention,
  controller,
  abstraction,
  names,
  maps,
  requirements
};

/// The meaning of a field at each cell. With the axis before those of the cells (none, /partition, or one
/// that names modes, pairs, agents, ...) it says how every reader has to read, compare, show and draw the
/// field.
enum class FieldKind : std::uint8_t {
  none,    ///< the field is not over cells: scales, sizes, lists, tables
  set,     ///< 0 or 1: the cell is in the set, or in that of an entry of the leading axis
  steps,   ///< a number of steps, or a flag
  choice,  ///< an index along the axis /partition, or a flag
  share,   ///< float32, in K a fraction of 1
  /// float32 from 0 to 1. As an integer its bits count, which order like the numbers.
  probability,
  actions,  ///< which joint actions of some inputs: a bit each, along a last axis of bytes
};

/// How the page of a report draws a field over cells: numbers as one map, or one for each entry of the
/// leading axis; sets over an axis as one map of the entries that hold; shares one map for each entry;
/// probabilities likewise, by their logarithm.
struct FieldMap {
  std::string kind = {};  ///< its name in the page: "delay"; empty: the field is not drawn
  /// For kinds without a title in the page: "Time to arrival".
  std::string title = {};
  /// Adds further members for the page, given the values that occur; may be empty.
  std::function<void(const std::set<std::int32_t>& values, Json& head)> legend = {};
};

/// How `query` shows a field at a cell; a field without a name and a label is not shown. Those over
/// /partition that are no steps of a policy, and those of other axes: sets as the names of the entries that
/// hold, probabilities one for each entry.
struct FieldQuery {
  std::string name = {};   ///< key in JSON: "arrival", "safe_modes"
  std::string label = {};  ///< before it in the text: "time to the goal"
  /// In the text, longer meanings of flags, and of "0".
  std::map<std::string, std::string> meanings = {};
  std::string group = {};  ///< object in JSON that holds it with others, and its column in CSV: "coalition"
  /// In the text a section of its own, or of its group, under this heading.
  std::string heading = {};
  std::string attribute =
      {};  ///< an attribute, in steps, that its group has, too, and with which the heading begins
  std::string entry = {};  ///< of sets: the term for an entry, "mode"; entries that hold are then counted
};

/// How commands show a field over cells; a command whose member is empty does not show it.
struct FieldDisplay {
  /// Name of its column in tables over cells (CSV, VTK): "delay", and "delay:alone" where it is over
  /// /partition, or over other names.
  std::string column = {};
  /// In a table the negative value that is worse than every number of steps, but better than lower values; 0:
  /// none.
  std::int32_t below_zero = 0;
  /// Its name in the comparison of two files: "safe set", "delay". Sets are compared as sets; others by
  /// value, of which more is better, or less; over an axis each entry with the one of the same name.
  std::string compared = {};
  bool less_is_better = false;
  FieldQuery query = {};
  FieldMap map = {};
};

struct Field {
  std::string path;  ///< "/delay"
  FieldKind kind = FieldKind::none;
  FieldSection section = FieldSection::maps;
  std::vector<ElementType> types;  ///< the dataset has one of these; empty: strings
  std::vector<std::string> axes;   ///< paths of scales; empty for a scale or a single value
  std::optional<FieldScale> scale = {};
  std::int64_t least = 0, most = kLargestValue;  ///< values of a field of integers
  std::vector<FieldAttribute> attributes = {};   ///< in the order in which they are written
  FieldDisplay display = {};
  /// Path of F, for steps over /partition: where F is negative, values of `max_delay` are lower
  /// bounds.
  std::string fixed_points = {};
};
using Fields = std::vector<Field>;

/// The values of a field of integers that have a meaning of their own.
[[nodiscard]] std::vector<FieldFlag> flags_of(const Field& field);
/// The meaning of a value; "steps" or "number" if it means a number.
[[nodiscard]] std::string status_of(const Field& field, std::int64_t value);
/// The probability that an integer of a field of probabilities stands for.
[[nodiscard]] double probability_of(std::int32_t bits);
/// The value as a number; null if it has another meaning.
[[nodiscard]] Json value_json(const Field& field, std::int64_t value);

/// The results of an analysis for the fields, by path. Scales with coordinates, and attributes that do not
/// depend on the analysis, need no entry.
struct FieldValues {
  struct Entry {
    ResultArray array;
    std::map<std::string, AttributeValue> attributes = {};  ///< those with FieldAttribute::is_computed
    std::string equals = {};  ///< the path of a field with the same elements; empty: none is known
  };
  std::map<std::string, Entry> entries;
  /// Lengths of scales that do not follow from the spec; an optional scale without a length is not in the
  /// file.
  std::map<std::string, std::uint64_t> lengths;
};

/// An array that owns its elements, which have the width of the type.
template <class Value>
[[nodiscard]] ResultArray owned_array(ElementType type, std::vector<Value> values) {
  auto shared = std::make_shared<const std::vector<Value>>(std::move(values));
  return {type, [shared](std::uint64_t begin, std::uint64_t count, void* out) {
            const Value* const first = shared->data() + begin;
            std::copy(first, first + count, static_cast<Value*>(out));
          }};
}

/// Arrays of `length` elements each, of one type, one after the other.
/// @throws std::invalid_argument if their types are not the same
[[nodiscard]] ResultArray stacked_array(std::uint64_t length, std::vector<ResultArray> arrays);

}  // namespace coordreq
