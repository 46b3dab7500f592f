#include "verify/verify_file.hpp"

#include <algorithm>

#include "results/version.hpp"
#include "results/write_results.hpp"

namespace coordreq {
namespace {

/// Puts what a declaration says of attributes into the form in which they are read.
class ExpectedAttributes {
 public:
  explicit ExpectedAttributes(StoredObject& object) : object_(object) {}

  /// Free text and what the analysis has found are not looked at here.
  void add(const FieldAttribute& attribute) {
    if (attribute.is_computed || attribute.name == "long_name") return;
    std::visit([&](const auto& value) { set(attribute.name, value); }, attribute.value);
  }

 private:
  void set(const std::string& name, const std::string& text) { object_.texts[name] = text; }
  void set(const std::string& name, double value) { object_.numbers[name] = {value}; }
  void set(const std::string& name, std::int64_t value) { object_.integers[name] = {value}; }
  void set(const std::string& name, std::uint64_t value) {
    object_.integers[name] = {static_cast<std::int64_t>(value)};
  }
  void set(const std::string& name, const std::vector<std::uint64_t>& values) {
    object_.integers[name].assign(values.begin(), values.end());
  }
  void set(const std::string& /*name*/, const std::vector<FieldFlag>& flags) {
    std::string& meanings = object_.texts["flag_meanings"];
    for (const FieldFlag& flag : flags) {
      object_.integers["flag_values"].push_back(flag.value);
      meanings += (meanings.empty() ? "" : " ") + flag.meaning;
    }
  }

  StoredObject& object_;
};

StoredObject expected_root(const ProblemSpec& spec) {
  StoredObject root{.path = "/"};
  root.texts["filetype"] = kResultsFiletype;
  root.integers["version"] = {kResultsVersion.begin(), kResultsVersion.end()};
  for (const FieldAttribute& attribute : header_attributes(spec)) ExpectedAttributes(root).add(attribute);
  return root;
}

StoredObject expected_object(const Field& field) {
  StoredObject object{.path = field.path, .axes = field.axes, .is_scale = field.scale.has_value()};
  for (const FieldAttribute& attribute : field.attributes) ExpectedAttributes(object).add(attribute);
  if (!field.scale) return object;
  // netCDF-4 knows an axis without coordinates by its name, which ends in the length.
  object.scale_name = std::holds_alternative<NoCoordinates>(field.scale->coordinates)
                          ? "This is a netCDF dimension"
                          : field.path.substr(field.path.rfind('/') + 1);
  return object;
}

bool same_integers(const std::vector<std::int64_t>& expected, const std::vector<std::int64_t>& actual) {
  return std::equal(expected.begin(), expected.end(), actual.begin(), actual.end(),
                    [](std::int64_t a, std::int64_t b) {
                      return a == b || (a == kLargestValue && (b == INT16_MAX || b == INT32_MAX));
                    });
}

class ObjectComparison {
 public:
  void compare(const StoredObject& expected, const StoredObject& actual) {
    path_ = expected.path;
    for (const auto& [name, text] : expected.texts) {
      const auto match = actual.texts.find(name);
      note(name, match != actual.texts.end() && match->second == text);
    }
    for (const auto& [name, values] : expected.integers) {
      const auto match = actual.integers.find(name);
      note(name, match != actual.integers.end() && same_integers(values, match->second));
    }
    for (const auto& [name, values] : expected.numbers) {
      const auto match = actual.numbers.find(name);
      note(name, match != actual.numbers.end() && match->second == values);
    }
    note("DIMENSION_LIST", expected.axes == actual.axes);
    note("CLASS", expected.is_scale == actual.is_scale);
    // An axis without coordinates has its length behind the words.
    note("NAME", actual.scale_name.compare(0, expected.scale_name.size(), expected.scale_name) == 0);
    if (!actual.is_blank) note("its elements", false);
    if (expected.is_scale) remember_dimension(actual);
  }

  [[nodiscard]] Finding finding() {
    std::sort(dimensions_.begin(), dimensions_.end());
    bool numbered = true;
    for (std::size_t i = 0; i < dimensions_.size(); ++i)
      numbered = numbered && dimensions_[i] == static_cast<std::int64_t>(i);
    path_ = "/";
    note("_Netcdf4Dimid", numbered);
    return tally_.finding();
  }

 private:
  void note(const std::string& attribute, bool right) {
    tally_.add_checked(1);
    if (!right)
      tally_.add_wrong(number_, [&] { return path_ + ": " + attribute + " is not as the spec says"; });
    ++number_;
  }

  void remember_dimension(const StoredObject& scale) {
    const auto found = scale.integers.find("_Netcdf4Dimid");
    const bool one = found != scale.integers.end() && found->second.size() == 1;
    dimensions_.push_back(one ? found->second.front() : -1);
  }

  Tally tally_{"attributes"};
  std::string path_;
  std::int64_t number_ = 0;
  std::vector<std::int64_t> dimensions_;
};

}  // namespace

std::vector<StoredObject> expected_objects(const ProblemSpec& spec, const Fields& fields) {
  std::vector<StoredObject> objects = {expected_root(spec)};
  for (const Field& field : fields) objects.push_back(expected_object(field));
  return objects;
}

Finding check_objects(const std::vector<StoredObject>& expected, const std::vector<StoredObject>& actual) {
  ObjectComparison comparison;
  for (std::size_t i = 0; i < expected.size(); ++i) comparison.compare(expected[i], actual[i]);
  return comparison.finding();
}

}  // namespace coordreq
