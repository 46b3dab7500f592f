#include "results/requirement_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "results/hdf5_attributes.hpp"
#include "results/memory_array.hpp"
#include "results/results_paths.hpp"

namespace coordreq {
namespace {

using hdf5::set_attribute;

std::vector<std::int64_t> first_numbers(std::size_t count) {
  std::vector<std::int64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

std::vector<std::string> names_of(const ResultContent& content, bool states) {
  std::vector<std::string> names;
  for (const ResultAxis& axis : content.axes) {
    if (axis.is_state == states) names.push_back(axis.name);
  }
  return names;
}

/// "x [m], v [m/s]": units stand in the long name, for CF has one unit a dataset.
std::string component_text(const ResultContent& content, bool states) {
  std::string text;
  for (const ResultAxis& axis : content.axes) {
    if (axis.is_state != states) continue;
    text += (text.empty() ? "" : ", ") + axis.name;
    if (!axis.unit.empty()) text += " [" + axis.unit + "]";
  }
  return text;
}

class RequirementWriter {
 public:
  RequirementWriter(NetcdfWriter& file, const ResultContent& content) : file_(file), content_(content) {}

  void write() {
    std::vector<std::string> names;
    for (const ResultRequirement& requirement : content_.requirements) names.push_back(requirement.name);
    const std::string axis = at("requirement");
    set_attribute(file_.add_coordinates(axis, names), "long_name", std::string("name of the requirement"));
    write_verdicts();
    write_names("state_name", names_of(content_, true), "name of the state");
    write_names("input_name", names_of(content_, false), "name of the input");
    for (std::size_t r = 0; r < content_.requirements.size(); ++r) {
      if (content_.requirements[r].path) write_path(paths::counterexample(r), *content_.requirements[r].path);
    }
  }

 private:
  static std::string at(const std::string& name) { return fmt::format("{}/{}", paths::kRequirements, name); }

  void write_names(const std::string& name, const std::vector<std::string>& names,
                   const std::string& long_name) {
    set_attribute(file_.add_coordinates(at(name), names), "long_name", long_name);
  }

  /// A plain number in UDUNITS, for a count of steps must not look like a time.
  template <class Value>
  hdf5::Handle write_list(const std::string& path, const std::string& axis, ElementType type,
                          const std::vector<Value>& values, const std::string& long_name) {
    hdf5::Handle dataset = file_.add_array(path, {axis}, array_of(type, values));
    describe(dataset, long_name);
    return dataset;
  }
  static void describe(const hdf5::Handle& dataset, const std::string& long_name) {
    set_attribute(dataset, "long_name", long_name);
    set_attribute(dataset, "units", std::string("1"));
  }

  /// @param get of a requirement
  template <class Value, class Get>
  hdf5::Handle write_of_each(const std::string& name, ElementType type, const Get& get,
                             const std::string& long_name) {
    std::vector<Value> values;
    for (const ResultRequirement& requirement : content_.requirements)
      values.push_back(static_cast<Value>(get(requirement)));
    return write_list(at(name), at("requirement"), type, values, long_name);
  }

  static void describe_flags(const hdf5::Handle& dataset, ElementType type,
                             const std::vector<std::int64_t>& values, const std::string& meanings) {
    set_attribute(dataset, "flag_values", type, values);
    set_attribute(dataset, "flag_meanings", meanings);
  }

  void write_verdicts() {
    using R = const ResultRequirement&;
    describe_flags(write_of_each<std::uint8_t>(
                       "holds", ElementType::uint8, [](R r) { return r.holds ? 1 : 0; }, "verdict"),
                   ElementType::uint8, {0, 1}, "fails holds");
    write_of_each<std::uint64_t>(
        "cells", ElementType::uint64, [](R r) { return r.cells; }, "cells that may meet the region");
    write_of_each<std::uint64_t>(
        "failing", ElementType::uint64, [](R r) { return r.failing; }, "cells of the region that fail");
    describe_flags(write_of_each<std::int32_t>(
                       "least_delay", ElementType::int32, [](R r) { return r.least_delay; },
                       "least delay of the cells of the region"),
                   ElementType::int32, {-2, -1, kForever}, "not_safe not_invariant unbounded");
    write_side(
        "reached_side", [](R r) { return r.reached_side; },
        "side of the domain beyond which the region may reach");
    const auto end = [](R r) { return r.path ? static_cast<int>(r.path->end) + 1 : 0; };
    describe_flags(write_of_each<std::uint8_t>("end", ElementType::uint8, end, "how the counterexample ends"),
                   ElementType::uint8, {0, 1, 2, 3, 4}, kEndMeanings);
    write_side(
        "left_side", [](R r) { return r.path ? r.path->left_side : std::nullopt; },
        "unsafe side of the domain through which the last action leads");
  }

  template <class Get>
  void write_side(const std::string& name, const Get& get, const std::string& long_name) {
    const std::vector<std::string> states = names_of(content_, true);
    describe_flags(write_of_each<std::int32_t>(
                       name, ElementType::int32,
                       [&get](const ResultRequirement& r) { return side_number(get(r)); }, long_name),
                   ElementType::int32, first_numbers(2 * states.size() + 1), side_meanings(states));
  }

  /// A dimension with the numbers 0, 1, ...
  void write_numbers(const std::string& path, std::size_t count, const std::string& long_name) {
    const std::vector<std::int64_t> wide = first_numbers(count);
    const std::vector<std::int32_t> numbers(wide.begin(), wide.end());
    describe(file_.add_coordinates(path, numbers.size(), array_of(ElementType::int32, numbers)), long_name);
  }

  void write_path(const std::string& group, const ResultPath& path) {
    const std::string sample = group + "/sample";
    write_numbers(sample, path.samples(), "number of the sample");
    write_list(group + "/cell", sample, ElementType::uint64, path.cell, "row-major linear index of the cell");
    const hdf5::Handle state = file_.add_array(group + "/state", {sample, at("state_name")},
                                               array_of(ElementType::float64, path.state));
    set_attribute(state, "long_name", "centre of the cell: " + component_text(content_, true));
    describe_flags(write_list(group + "/delay", sample, ElementType::int32, path.delay, "delay of the cell"),
                   ElementType::int32, {-2, -1, kForever}, "not_safe not_invariant unbounded");
    describe_flags(write_list(group + "/collision_time", sample, ElementType::int32, path.collision_time,
                              "collision time of the cell"),
                   ElementType::int32, {0, kForever}, "not_safe never");
    if (path.steps() == 0) return;
    const std::string step = group + "/step";
    write_numbers(step, path.steps(), "number of the step");
    const hdf5::Handle input = file_.add_array(group + "/input", {step, at("input_name")},
                                               array_of(ElementType::float64, path.input));
    set_attribute(input, "long_name", "joint input: " + component_text(content_, false));
    std::vector<std::uint8_t> phases;
    for (const EscapePhase phase : path.phase) phases.push_back(static_cast<std::uint8_t>(phase));
    describe_flags(
        write_list(group + "/phase", step, ElementType::uint8, phases, "what the joint input is taken from"),
        ElementType::uint8, {0, 1}, kPhaseMeanings);
  }

  static constexpr std::int64_t kForever = std::numeric_limits<std::int32_t>::max();

  NetcdfWriter& file_;
  const ResultContent& content_;
};

}  // namespace

void write_requirements(NetcdfWriter& file, const ResultContent& content) {
  if (!content.requirements.empty()) RequirementWriter(file, content).write();
}

std::string side_meanings(const std::vector<std::string>& states) {
  std::string text = "none";
  for (const std::string& state : states) text += " below_" + state + " above_" + state;
  return text;
}

std::int32_t side_number(const std::optional<ResultSide>& side) {
  return side ? static_cast<std::int32_t>(2 * side->state) + (side->above ? 2 : 1) : 0;
}

std::optional<ResultSide> side_of_number(std::int64_t number) {
  if (number == 0) return std::nullopt;
  return ResultSide{static_cast<std::size_t>((number - 1) / 2), number % 2 == 0};
}

}  // namespace coordreq
