#include "results/write_runs.hpp"

#include <limits>
#include <numeric>

#include "results/hdf5_handle.hpp"
#include "results/memory_array.hpp"
#include "results/netcdf_writer.hpp"
#include "results/sha256.hpp"
#include "results/version.hpp"
#include "results/whole_file.hpp"
#include "spec/unit_text.hpp"

namespace coordreq {
namespace {

using hdf5::set_attribute;
using Components = std::vector<RunContent::Component>;

void describe(const hdf5::Handle& dataset, const std::string& long_name, const std::string& unit = "1") {
  set_attribute(dataset, "long_name", long_name);
  set_attribute(dataset, "units", unit);
}

/// "x [m], v [m/s]": components of one dataset may differ in their units.
std::string component_text(const Components& components) {
  std::string text;
  for (const RunContent::Component& component : components) {
    text += (text.empty() ? "" : ", ") + component.name + " [" + udunits_spelling(component.unit) + "]";
  }
  return text;
}

class RunsFile {
 public:
  RunsFile(const std::string& path, const RunContent& content, ThreadTeam& team)
      : content_(content), file_(path, team) {}

  void write() {
    write_header();
    write_axes();
    write_components("/state", "/state_name", content_.states, content_.state, "true state");
    if (content_.measured) {
      write_components("/measured", "/state_name", content_.states, *content_.measured, "measured state");
    }
    write_components("/input", "/input_name", content_.inputs, content_.input, "input from the sample on");
    if (content_.disturbance) {
      write_components("/disturbance", "/disturbance_name", content_.disturbances, *content_.disturbance,
                       "disturbance from the sample on");
    }
    write_coordination();
    write_ends();
    file_.finish();
  }

 private:
  void write_header() {
    const hdf5::Handle root = hdf5::open_object(file_.file(), "/");
    set_attribute(root, "filetype", std::string("coordreq-runs"));
    set_attribute(root, "version", ElementType::int32, {1, 0});
    set_attribute(root, "coordreq_version", std::string(program_version()));
    set_attribute(root, "git_sha1", std::string(program_git_sha1()));
    set_attribute(root, "title", content_.name);
    set_attribute(root, "Conventions", std::string("CF-1.10"));
    set_attribute(root, "spec_sha256", sha256_hex(content_.spec_text));
    set_attribute(root, "period", content_.period);
    set_attribute(root, "period_unit", period_unit());
    set_attribute(root, "guarantee", content_.guarantee);
    set_attribute(root, "partition", content_.partition);
    set_attribute(root, "connection_delay", content_.connection_delay);
    set_attribute(root, "policy", content_.policy);
    set_attribute(root, "disturbance_policy", content_.disturbance_policy);
    set_attribute(root, "seed", content_.seed);
    const hdf5::Handle spec = file_.add_text("/spec", content_.spec_text);
    set_attribute(spec, "long_name", std::string("problem spec as analysed"));
  }

  [[nodiscard]] std::string period_unit() const {
    return content_.period_unit.empty() ? std::string() : udunits_spelling(content_.period_unit);
  }

  void write_axes() {
    std::vector<std::int32_t> numbers(content_.runs);
    std::iota(numbers.begin(), numbers.end(), 0);
    describe(file_.add_coordinates("/run", numbers.size(), array_of(ElementType::int32, numbers)),
             "number of the run");
    describe(
        file_.add_coordinates("/time", content_.time.size(), array_of(ElementType::float64, content_.time)),
        "time of the sample", udunits_spelling(content_.period_unit));
    write_names("/state_name", content_.states, "state");
    write_names("/input_name", content_.inputs, "input");
    if (content_.disturbance) write_names("/disturbance_name", content_.disturbances, "disturbance");
  }

  void write_names(const std::string& path, const Components& components, const std::string& kind) {
    std::vector<std::string> names;
    for (const RunContent::Component& component : components) names.push_back(component.name);
    set_attribute(file_.add_coordinates(path, names), "long_name", "name of the " + kind);
  }

  /// Units stand in the long name, since CF has one unit a dataset.
  void write_components(const std::string& path, const std::string& names, const Components& components,
                        const ResultArray& array, const std::string& kind) {
    const hdf5::Handle dataset = file_.add_array(path, {"/run", "/time", names}, array);
    set_attribute(dataset, "long_name", kind + ": " + component_text(components));
  }

  void write_coordination() {
    constexpr std::int64_t kForever = std::numeric_limits<std::int32_t>::max();
    const hdf5::Handle countdown = file_.add_array("/countdown", {"/run", "/time"}, content_.countdown);
    describe(countdown, "steps that the agents still go on without coordination");
    describe_flags(countdown, ElementType::int32, {RunContent::kNoSample, kForever}, "no_sample never");
    const hdf5::Handle delay = file_.add_array("/delay", {"/run", "/time"}, content_.delay);
    describe(delay, "delay of the cell: steps without coordination that keep the system safe");
    describe_flags(delay, ElementType::int32, {RunContent::kNoSample, -2, -1, kForever},
                   "no_sample not_safe not_invariant unbounded");
    const hdf5::Handle coordinated = file_.add_array("/coordinated", {"/run", "/time"}, content_.coordinated);
    describe(coordinated, "the agents coordinate the step that follows the sample");
    describe_flags(coordinated, ElementType::uint8, {0, 1, RunContent::kNoStep}, "alone coordinated no_step");
    // In the units of what `safe` compares, which may be several.
    set_attribute(file_.add_array("/margin", {"/run", "/time"}, content_.margin), "long_name",
                  std::string("quantitative semantics of safe at the true state"));
  }

  void write_ends() {
    describe(file_.add_array("/samples", {"/run"}, content_.samples), "number of samples of the run");
    const hdf5::Handle outcome = file_.add_array("/outcome", {"/run"}, content_.outcome);
    describe(outcome, "how the run ended");
    std::vector<std::int64_t> values(content_.outcome_names.size());
    std::iota(values.begin(), values.end(), 0);
    std::string meanings;
    for (const std::string& name : content_.outcome_names) meanings += (meanings.empty() ? "" : " ") + name;
    describe_flags(outcome, ElementType::uint8, values, meanings);
  }

  static void describe_flags(const hdf5::Handle& dataset, ElementType type,
                             const std::vector<std::int64_t>& values, const std::string& meanings) {
    set_attribute(dataset, "flag_values", type, values);
    set_attribute(dataset, "flag_meanings", meanings);
  }

  const RunContent& content_;
  NetcdfWriter file_;
};

}  // namespace

void write_runs(const std::string& path, const RunContent& content, ThreadTeam& team) {
  write_whole_file(path, "the runs",
                   [&](const std::string& temporary) { RunsFile(temporary, content, team).write(); });
}

}  // namespace coordreq
