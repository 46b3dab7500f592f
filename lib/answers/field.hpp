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

// A dataset of the results file, declared once: what writes the file, reads it, checks it and shows what it
// holds goes over these declarations and knows no dataset by name.
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
  FillArray of_cell;  ///< uint32 [cells], the list that a cell is in, or kNone
};

struct ResultArray {
  ElementType type = ElementType::uint8;
  FillArray fill;
  /// Elements of each cell, of an array over cells of which each of several processes knows its own; 0: none.
  std::uint64_t of_cell = 0;
  /// What the elements are, if they are lists of cells, of which several processes make one together.
  std::shared_ptr<const CellLists> lists = {};

  /// Each of several processes knows something of it.
  [[nodiscard]] bool is_divided() const { return of_cell != 0 || lists != nullptr; }
};

/// A value that means a word; kLargestValue stands for the largest value of the type that the field has.
struct FieldFlag {
  std::int64_t value = 0;
  std::string word;
};
inline constexpr std::int64_t kLargestValue = std::numeric_limits<std::int64_t>::max();

/// A list of uint64 is stored as one; flags become the two attributes `flag_values`, of the type of the
/// field, and `flag_meanings`.
using AttributeValue = std::variant<std::string, double, std::int64_t, std::uint64_t,
                                    std::vector<std::uint64_t>, std::vector<FieldFlag>>;
struct FieldAttribute {
  std::string name;
  AttributeValue value;
  /// The analysis finds it: `value` tells no more than its type, and of a list the length.
  bool is_found = false;
};

/// Where the coordinates of an axis come from: it has none but its length; the numbers 0, 1, ... (or from
/// another one on); names; or grid points, which are asked for one by one, since there may be very many.
struct NoCoordinates {};
struct Numbers {
  std::int32_t first = 0;
};
struct GridPoints {
  std::function<double(std::uint64_t)> at;
};
struct FieldScale {
  std::variant<NoCoordinates, Numbers, std::vector<std::string>, GridPoints> coordinates;
  /// The length; not always does the spec tell it.
  std::uint64_t least = 0, most = 0;
  /// Whether it is there, and with it all that is over it, the spec does not tell either.
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

/// What a field says of each cell. Together with the axis before those of the cells (none, /partition, or one
/// that names modes, pairs, agents, ...) it tells every reader how to read, compare, show and draw the field.
enum class FieldKind : std::uint8_t {
  none,    ///< nothing of single cells: scales, sizes, lists, tables
  set,     ///< 0 or 1: the cell is in the set, or in that of an entry of the leading axis
  steps,   ///< a number of steps, or what a flag says
  choice,  ///< a place along the axis /partition, or what a flag says
  share,   ///< float32, in K a part of 1
  /// float32 from 0 to 1. As an integer it is its bits, which order like the numbers.
  probability,
  actions,  ///< which joint actions of some inputs: a bit each, along a last axis of bytes
};

/// How the page of a report draws a field over cells: numbers as one map, or one for each entry of the
/// leading axis; sets over an axis as one map of the entries that hold; shares one map for each entry;
/// probabilities likewise, by their logarithm.
struct FieldMap {
  std::string kind = {};  ///< what the page knows it by: "delay"; empty: it is not drawn
  /// Of kinds that the page has no words for: "Time to arrival".
  std::string title = {};
  /// What else the page is to know, given the values that occur; may be empty.
  std::function<void(const std::set<std::int32_t>& found, Json& head)> legend = {};
};

/// How `query` tells a field of the cell asked for; where nothing is said it does not. Those over /partition
/// that are no steps of a policy, and those of other axes: sets as the names of the entries that hold,
/// probabilities one for each entry.
struct FieldAsked {
  std::string name = {};   ///< key in JSON: "arrival", "safe_modes"
  std::string words = {};  ///< before it in the text: "time to the goal"
  /// In the text, what words of flags mean, and "0", where that is more than they say.
  std::map<std::string, std::string> meanings = {};
  std::string group =
      {};  ///< object in JSON that it stands in with others, and its column in CSV: "coalition"
  /// In the text a section of its own, or of its group, under this heading.
  std::string heading = {};
  std::string attribute =
      {};                  ///< an attribute, in steps, that its group tells too, and the heading begins with
  std::string entry = {};  ///< of sets: what an entry is called, "mode"; then they are counted
};

/// How commands show a field over cells; where nothing is said they do not.
struct FieldShown {
  /// As a column of tables over cells (CSV, VTK): "delay", and "delay:alone" where it is over /partition, or
  /// over other names.
  std::string column = {};
  /// In a table a value that is worse than every number of steps, but better than what is lower; 0: none.
  std::int32_t below_zero = 0;
  /// What it is called in the comparison of two files: "safe set", "delay". Sets are compared as such; others
  /// by value, of which more is better, or less; over an axis each with that of the same name.
  std::string compared = {};
  bool less_is_better = false;
  FieldAsked asked = {};
  FieldMap map = {};
};

struct Field {
  std::string path;  ///< "/delay"
  FieldKind kind = FieldKind::none;
  FieldSection section = FieldSection::maps;
  std::vector<ElementType> types;  ///< it has one of these; none: strings
  std::vector<std::string> axes;   ///< paths of scales; none for a scale or a single value
  std::optional<FieldScale> scale = {};
  std::int64_t least = 0, most = kLargestValue;  ///< values of a field of integers
  std::vector<FieldAttribute> attributes = {};   ///< in the order in which they are written
  FieldShown shown = {};
  /// Of steps over /partition, the path of their F: where that is negative, `max_delay` is a lower bound.
  std::string fixed_points = {};
};
using Fields = std::vector<Field>;

/// What values of a field of integers mean, as far as they mean a word.
[[nodiscard]] std::vector<FieldFlag> flags_of(const Field& field);
/// The word that a value means; "steps" or "number" if it is one.
[[nodiscard]] std::string status_of(const Field& field, std::int64_t value);
/// The probability that an integer of such a field stands for.
[[nodiscard]] double probability_of(std::int32_t bits);
/// The value; null if it means a word.
[[nodiscard]] Json value_json(const Field& field, std::int64_t value);

/// What an analysis has found for the fields, by path. Scales with coordinates and what does not depend on
/// the analysis need no entry.
struct FieldValues {
  struct Entry {
    ResultArray array;
    std::map<std::string, AttributeValue> attributes = {};  ///< those that are found
    std::string equals = {};  ///< the path of a field that is known to have the same elements; or empty
  };
  std::map<std::string, Entry> entries;
  /// Lengths of scales that the spec does not tell; optional scales without one are not there.
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
[[nodiscard]] ResultArray stacked_array(std::uint64_t length, std::vector<ResultArray> parts);

}  // namespace coordreq
