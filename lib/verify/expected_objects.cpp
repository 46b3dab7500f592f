#include "verify/expected_objects.hpp"

#include <algorithm>

#include "model/input_class.hpp"
#include "model/input_space.hpp"
#include "results/results_paths.hpp"
#include "results/sha256.hpp"
#include "spec/unit_text.hpp"
#include "results/version.hpp"
#include "spec/partition_names.hpp"
#include "verify/sampled_map.hpp"

namespace coordreq {
namespace {

using Paths = std::vector<std::string>;

/// Makes the expected objects one by one.
class Expectation {
 public:
  Expectation(const ProblemSpec& spec, const StoredExtras& extras) : spec_(spec), extras_(extras) {
    for (const StateSpec& state : spec.states) cells_.push_back("/" + state.name);
  }

  std::vector<StoredObject> run() {
    add_root();
    add_scales();
    add_sets();
    add_steps();
    for (std::size_t p = 0; p < spec_.coordination.partitions.size(); ++p) add_partition(p);
    if (spec_.network) add_network();
    if (extras_.controller) add_joint_bits(paths::kController);
    if (spec_.controller.file) add_joint_bits(paths::kListed);
    if (spec_.coordination.horizon) add_coalitions();
    if (spec_.coordination.convention) add_convention();
    for (std::size_t i = 0; extras_.abstraction && i < spec_.states.size(); ++i) add_table(i);
    if (!extras_.paths.empty()) add_requirements();
    return std::move(objects_);
  }

 private:
  StoredObject& add(const std::string& path) { return objects_.emplace_back(StoredObject{.path = path}); }

  StoredObject& add_array(const std::string& path, const Paths& axes) {
    StoredObject& object = add(path);
    object.axes = axes;
    object.texts["units"] = "1";
    return object;
  }

  StoredObject& add_scale(const std::string& path) {
    StoredObject& object = add(path);
    object.is_scale = true;
    object.scale_name = path.substr(path.rfind('/') + 1);
    return object;
  }

  /// An axis without coordinates; netCDF-4 knows it by its name, which ends in the length.
  void add_length(const std::string& path) { add_scale(path).scale_name = "This is a netCDF dimension"; }

  static void describe_flags(StoredObject& object, std::vector<std::int64_t> values,
                             const std::string& meanings) {
    object.integers["flag_values"] = std::move(values);
    object.texts["flag_meanings"] = meanings;
  }

  [[nodiscard]] Paths with_partition() const {
    Paths axes = cells_;
    axes.insert(axes.begin(), "/partition");
    return axes;
  }

  void add_root() {
    StoredObject& root = add("/");
    root.texts["filetype"] = kResultsFiletype;
    root.integers["version"] = {kResultsVersion.begin(), kResultsVersion.end()};
    root.texts["title"] = spec_.name;
    root.texts["Conventions"] = "CF-1.10";
    root.texts["spec_sha256"] = sha256_hex(spec_.text);
    root.texts["guarantee"] = guarantee();
    root.numbers["period"] = {nearest_double(spec_.dynamics.period)};
    root.texts["period_unit"] = spec_.dynamics.unit.empty() ? "" : udunits_spelling(spec_.dynamics.unit);
  }

  /// Contract, "What is guaranteed".
  [[nodiscard]] std::string guarantee() const {
    if (spec_.abstraction.safe == Membership::center) return "samples-center";
    return spec_.abstraction.between_samples ? "continuous" : "samples";
  }

  void add_axis(const std::string& name, const std::string& unit, const std::string& role,
                const GridSpec* grid) {
    StoredObject& axis = add_scale("/" + name);
    axis.texts["units"] = udunits_spelling(unit);
    axis.texts["role"] = role;
    if (grid != nullptr) axis.numbers["step"] = {nearest_double(grid->step)};
  }

  void add_scales() {
    for (const StateSpec& state : spec_.states) add_axis(state.name, state.unit, "state", &state.grid);
    for (const InputSpec& input : spec_.inputs)
      add_axis(input.name, input.unit, "input", input.grid ? &*input.grid : nullptr);
    add_scale("/partition");
    add_scale("/layer").texts["units"] = "1";
  }

  void add_sets() {
    describe_flags(add_array("/safe", cells_), {0, 1}, "not_safe safe");
    describe_flags(add_array("/invariant", cells_), {0, 1}, "not_invariant invariant");
    describe_flags(add_array("/collision_time", cells_), {0, kLargest}, "not_safe never");
  }

  void add_steps() {
    describe_flags(add_array("/delay", with_partition()), {-2, -1, kLargest},
                   "not_safe not_invariant unbounded");
    StoredObject& trigger = add_array("/trigger", with_partition());
    describe_flags(trigger, {-3, -2, -1, kLargest},
                   "connection_must_stand_already not_safe not_invariant never");
    trigger.integers["connection_delay"] = {spec_.coordination.connection_delay};
    add_array("/layer_size", {"/partition", "/layer"});
    describe_flags(add_array("/fixed_point_index", {"/partition"}), {-1}, "unknown_because_truncated");
  }

  void add_bits(const std::string& path, const InputClass& actions) {
    add_length(path + ":byte");
    Paths axes = cells_;
    axes.push_back(path + ":byte");
    StoredObject& bits = add_array(path, axes);
    std::string names;
    for (const std::int32_t i : actions.inputs())
      names += (names.empty() ? "" : " ") + spec_.inputs[static_cast<std::size_t>(i)].name;
    bits.texts["inputs"] = names;
    bits.texts["bitorder"] = "little";
    bits.integers["actions"] = {actions.actions()};
  }

  void add_partition(std::size_t p) {
    const PartitionSpec& partition = spec_.coordination.partitions[p];
    if (extras_.layers[p]) {
      const std::string group = "/layers/" + partition.name;
      add_length(group + "/bound");
      add_length(group + "/position");
      add_array(group + "/start", {group + "/bound"});
      add_array(group + "/cell", {group + "/position"});
    }
    const InputSpace inputs = make_input_space(spec_);
    for (const auto& agents : partition.classes) {
      if (extras_.actions[p])
        add_bits("/actions/" + partition.name + "/" + class_name(spec_.agents, agents),
                 class_of(spec_, inputs, agents));
    }
  }

  void add_network() {
    add_scale("/mode");
    Paths axes = cells_;
    axes.insert(axes.begin(), "/mode");
    describe_flags(add_array("/network_safe", axes), {0, 1}, "not_safe safe");
  }

  void add_coalitions() {
    StoredObject& coalition = add_array("/coalition", cells_);
    describe_flags(coalition, {-3, -2, -1}, "no_partition_suffices not_safe not_invariant");
    coalition.integers["horizon"] = {*spec_.coordination.horizon};
    if (spec_.agents.size() < 2) return;
    add_scale("/pair");
    Paths axes = cells_;
    axes.insert(axes.begin(), "/pair");
    describe_flags(add_array("/critical_pair", axes), {0, 1}, "not_critical critical");
  }

  void add_joint_bits(const std::string& path) {
    std::vector<std::int32_t> everyone;
    for (std::size_t a = 0; a < spec_.agents.size(); ++a) everyone.push_back(static_cast<std::int32_t>(a));
    add_bits(path, class_of(spec_, make_input_space(spec_), everyone));
  }

  void add_convention() {
    add_scale(paths::kAgent);
    Paths axes = cells_;
    axes.insert(axes.begin(), paths::kAgent);
    add_array(paths::kConventionFreedom, axes);
    for (std::size_t a = 0; extras_.convention && a < spec_.agents.size(); ++a) {
      add_bits(paths::convention(spec_.agents[a].name),
               class_of(spec_, make_input_space(spec_), {static_cast<std::int32_t>(a)}));
    }
  }

  void add_table(std::size_t state) {
    const Influences influences = influences_on(spec_, state);
    std::vector<std::size_t> states = influences.moving;
    states.insert(states.end(), influences.parameters.begin(), influences.parameters.end());
    std::sort(states.begin(), states.end());
    Paths axes;
    for (const std::size_t j : states) axes.push_back("/" + spec_.states[j].name);
    for (const std::size_t j : influences.inputs) axes.push_back("/" + spec_.inputs[j].name);
    const std::string group = "/abstraction/" + spec_.states[state].name;
    add_array(group + "/first", axes);
    add_array(group + "/last", axes);
  }

  void add_requirements() {
    const std::string group = "/counterexample";
    const std::string requirement = group + "/requirement";
    add_scale(requirement);
    add_scale(group + "/state_name");
    add_scale(group + "/input_name");
    add_array(group + "/cells", {requirement});
    add_array(group + "/failing", {requirement});
    describe_flags(add_array(group + "/holds", {requirement}), {0, 1}, "fails holds");
    describe_flags(add_array(group + "/least_delay", {requirement}), {-2, -1, kLargest},
                   "not_safe not_invariant unbounded");
    describe_flags(add_array(group + "/end", {requirement}), {0, 1, 2, 3, 4},
                   "none outside_safe_set left_domain unsafe_between_samples no_allowed_action");
    std::string sides = "none";
    std::vector<std::int64_t> numbers = {0};
    for (const StateSpec& state : spec_.states) {
      sides += " below_" + state.name + " above_" + state.name;
      numbers.push_back(numbers.back() + 1);
      numbers.push_back(numbers.back() + 1);
    }
    for (const char* name : {"/reached_side", "/left_side"})
      describe_flags(add_array(group + name, {requirement}), numbers, sides);
    for (std::size_t r = 0; r < extras_.paths.size(); ++r) {
      if (extras_.paths[r].samples) add_path(group, std::to_string(r), extras_.paths[r].steps);
    }
  }

  void add_path(const std::string& parent, const std::string& number, bool has_steps) {
    const std::string group = parent + "/" + number;
    const std::string sample = group + "/sample";
    add_scale(sample).texts["units"] = "1";
    add_array(group + "/cell", {sample});
    add(group + "/state").axes = {sample, parent + "/state_name"};
    describe_flags(add_array(group + "/delay", {sample}), {-2, -1, kLargest},
                   "not_safe not_invariant unbounded");
    describe_flags(add_array(group + "/collision_time", {sample}), {0, kLargest}, "not_safe never");
    if (!has_steps) return;
    const std::string step = group + "/step";
    add_scale(step).texts["units"] = "1";
    add(group + "/input").axes = {step, parent + "/input_name"};
    describe_flags(add_array(group + "/phase", {step}), {0, 1}, "independent evasive");
  }

  /// Stands for the largest value of the type an array has.
  static constexpr std::int64_t kLargest = INT64_MAX;

  const ProblemSpec& spec_;
  const StoredExtras& extras_;
  Paths cells_;
  std::vector<StoredObject> objects_;
};

bool same_integers(const std::vector<std::int64_t>& expected, const std::vector<std::int64_t>& found) {
  return std::equal(expected.begin(), expected.end(), found.begin(), found.end(),
                    [](std::int64_t a, std::int64_t b) {
                      return a == b || (a == INT64_MAX && (b == INT16_MAX || b == INT32_MAX));
                    });
}

class Comparison {
 public:
  void compare(const StoredObject& expected, const StoredObject& found) {
    path_ = expected.path;
    for (const auto& [name, text] : expected.texts) {
      const auto place = found.texts.find(name);
      note(name, place != found.texts.end() && place->second == text);
    }
    for (const auto& [name, values] : expected.integers) {
      const auto place = found.integers.find(name);
      note(name, place != found.integers.end() && same_integers(values, place->second));
    }
    for (const auto& [name, values] : expected.numbers) {
      const auto place = found.numbers.find(name);
      note(name, place != found.numbers.end() && place->second == values);
    }
    note("DIMENSION_LIST", expected.axes == found.axes);
    note("CLASS", expected.is_scale == found.is_scale);
    // An axis without coordinates has its length behind the words.
    note("NAME", found.scale_name.compare(0, expected.scale_name.size(), expected.scale_name) == 0);
    if (expected.is_scale) remember_dimension(found);
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
    const auto place = scale.integers.find("_Netcdf4Dimid");
    const bool one = place != scale.integers.end() && place->second.size() == 1;
    dimensions_.push_back(one ? place->second.front() : -1);
  }

  Tally tally_{"attributes"};
  std::string path_;
  std::int64_t number_ = 0;
  std::vector<std::int64_t> dimensions_;
};

}  // namespace

std::vector<StoredObject> expected_objects(const ProblemSpec& spec, const StoredExtras& extras) {
  return Expectation(spec, extras).run();
}

Finding check_objects(const std::vector<StoredObject>& expected, const std::vector<StoredObject>& found) {
  Comparison comparison;
  for (std::size_t i = 0; i < expected.size(); ++i) comparison.compare(expected[i], found[i]);
  return comparison.finding();
}

}  // namespace coordreq
