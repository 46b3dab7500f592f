#include <algorithm>
#include <functional>

#include "base/error.hpp"
#include "results/child_trial.hpp"
#include "results/read_requirements.hpp"
#include "results/reading.hpp"
#include "results/results_file.hpp"
#include "results/results_paths.hpp"
#include "results/results_reader.hpp"
#include "results/sha256.hpp"
#include "spec/partition_names.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

using Shape = std::vector<std::uint64_t>;

/// Reads and checks part by part; each function throws ResultsError naming the object.
class PartsReader {
 public:
  explicit PartsReader(const std::string& path) : file_(path) {}

  ResultsParts read() {
    read_attributes();
    read_spec_text();
    check_axes();
    read_partitions();
    check_cell_arrays();
    if (parts_.spec.network) read_network(*parts_.spec.network);
    for (std::size_t p = 0; p < parts_.partitions.size(); ++p) check_extras(p);
    if (file_.exists(paths::kController)) check_bits(paths::kController, joint_actions(all_inputs()));
    if (parts_.spec.controller.file) {
      check_bits(paths::kListed, joint_actions(all_inputs()));
      parts_.attributes.controller_sha256 = file_.text(paths::kListed, "sha256");
    }
    if (parts_.spec.coordination.convention) check_convention();
    if (file_.exists(paths::kAbstraction)) read_tables();
    if (parts_.spec.coordination.horizon) read_coalitions();
    read_requirements();
    return std::move(parts_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& object) const {
    throw ResultsError(what, file_.place(object));
  }

  void read_attributes() {
    StoredAttributes& attributes = parts_.attributes;
    attributes.title = file_.text("/", "title");
    attributes.conventions = file_.text("/", "Conventions");
    attributes.coordreq_version = file_.text("/", "coordreq_version");
    attributes.git_sha1 = file_.text("/", "git_sha1");
    attributes.spec_sha256 = file_.text("/", "spec_sha256");
    attributes.guarantee = file_.text("/", "guarantee");
    attributes.period = file_.number("/", "period");
    attributes.period_unit = file_.text("/", "period_unit");
    attributes.safe_cells = file_.natural("/safe", "cells");
    attributes.invariant_cells = file_.natural("/invariant", "cells");
    attributes.iterations = file_.integer("/collision_time", "iterations");
    attributes.connection_delay = file_.integer("/trigger", "connection_delay");
  }

  void read_spec_text() {
    file_.expect_shape("/spec", {});
    std::string text = file_.texts("/spec").front();
    const std::string digest = sha256_hex(text);
    if (digest != parts_.attributes.spec_sha256) {
      fail("the SHA-256 of the spec is " + digest + ", the attribute spec_sha256 says " +
               parts_.attributes.spec_sha256,
           "/spec");
    }
    try {
      parts_.spec = read_spec(std::move(text), "spec");
    } catch (const Error& error) {
      fail(std::string("the spec is not valid: ") + error.what(), "/spec");
    }
  }

  void check_axis(const std::string& name, std::int64_t count,
                  const std::function<Rational(std::int64_t)>& at) {
    const std::string path = "/" + name;
    file_.expect_shape(path, {static_cast<std::uint64_t>(count)});
    const std::vector<double> points = file_.numbers(path);
    for (std::int64_t k = 0; k < count; ++k) {
      if (points[static_cast<std::size_t>(k)] != nearest_double(at(k))) {
        fail("grid point " + std::to_string(k) + " is not that of the spec", path);
      }
    }
  }

  void check_axes() {
    for (const StateSpec& state : parts_.spec.states) {
      check_axis(state.name, state.grid.count, [&state](std::int64_t k) {
        return Rational(state.grid.first + state.grid.step * Rational(static_cast<long>(k)));
      });
      shape_.push_back(static_cast<std::uint64_t>(state.grid.count));
      cells_ *= shape_.back();
    }
    for (const InputSpec& input : parts_.spec.inputs) {
      check_axis(input.name, static_cast<std::int64_t>(input.values.size()),
                 [&input](std::int64_t k) { return input.values[static_cast<std::size_t>(k)]; });
    }
  }

  [[nodiscard]] std::vector<std::int32_t> all_inputs() const {
    std::vector<std::int32_t> inputs;
    for (std::size_t i = 0; i < parts_.spec.inputs.size(); ++i)
      inputs.push_back(static_cast<std::int32_t>(i));
    return inputs;
  }

  [[nodiscard]] std::int64_t joint_actions(const std::vector<std::int32_t>& inputs) const {
    std::int64_t actions = 1;
    for (const std::int32_t i : inputs) {
      actions *= static_cast<std::int64_t>(parts_.spec.inputs[static_cast<std::size_t>(i)].values.size());
    }
    return actions;
  }

  [[nodiscard]] std::int64_t class_actions(const std::vector<std::int32_t>& agents) const {
    std::int64_t actions = 1;
    for (const std::int32_t agent : agents) {
      actions *= joint_actions(parts_.spec.agents[static_cast<std::size_t>(agent)].inputs);
    }
    return actions;
  }

  void read_partitions() {
    const std::vector<PartitionSpec>& wanted = parts_.spec.coordination.partitions;
    const std::vector<std::string> names = file_.texts("/partition");
    const auto same = [](const std::string& name, const PartitionSpec& spec) { return name == spec.name; };
    if (!std::equal(names.begin(), names.end(), wanted.begin(), wanted.end(), same)) {
      fail("the partitions are not those of the spec", "/partition");
    }
    const std::uint64_t layers = layer_count();
    file_.expect_shape("/layer_size", {names.size(), layers});
    file_.expect_shape("/fixed_point_index", {names.size()});
    expect_type("/layer_size", ElementType::uint64);
    expect_type("/fixed_point_index", ElementType::int32);
    const std::vector<std::int64_t> sizes = file_.integers("/layer_size");
    const std::vector<std::int64_t> fixed_points = file_.integers("/fixed_point_index");
    for (std::size_t p = 0; p < names.size(); ++p) {
      const auto row = sizes.begin() + static_cast<std::ptrdiff_t>(p * layers);
      add_partition(wanted[p], fixed_points[p], {row, row + static_cast<std::ptrdiff_t>(layers)});
    }
  }

  [[nodiscard]] std::uint64_t layer_count() const {
    const Shape shape = file_.shape("/layer");
    const std::vector<std::int64_t> numbers = file_.integers("/layer");
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if (numbers[k] != static_cast<std::int64_t>(k)) fail("not the numbers 0, 1, ...", "/layer");
    }
    if (shape.size() != 1 || shape.front() == 0) fail("not a list", "/layer");
    return shape.front();
  }

  void add_partition(const PartitionSpec& spec, std::int64_t fixed_point, std::vector<std::int64_t> sizes) {
    StoredPartition& partition = parts_.partitions.emplace_back();
    partition.name = spec.name;
    for (const auto& agents : spec.classes) {
      partition.classes.push_back(class_name(parts_.spec.agents, agents));
      partition.actions.push_back(class_actions(agents));
    }
    if (fixed_point < -1 || fixed_point >= static_cast<std::int64_t>(sizes.size())) {
      fail("found " + std::to_string(fixed_point) + ", expected a layer or -1", "/fixed_point_index");
    }
    partition.fixed_point_index = static_cast<std::int32_t>(fixed_point);
    partition.padded_sizes.assign(sizes.begin(), sizes.end());
    if (fixed_point >= 0) sizes.resize(static_cast<std::size_t>(fixed_point) + 1);
    partition.layer_sizes.assign(sizes.begin(), sizes.end());
  }

  void expect_type(const std::string& dataset, ElementType type) const {
    if (file_.element_type(dataset) != type) fail("elements of another type than expected", dataset);
  }

  void expect_steps(const std::string& dataset) const {
    const ElementType type = file_.element_type(dataset);
    if (type != ElementType::int16 && type != ElementType::int32) {
      fail("elements of another type than int16 and int32", dataset);
    }
  }

  void check_cell_arrays() const {
    Shape with_partition = shape_;
    with_partition.insert(with_partition.begin(), parts_.partitions.size());
    for (const char* path : {"/safe", "/invariant"}) {
      file_.expect_shape(path, shape_);
      expect_type(path, ElementType::uint8);
    }
    file_.expect_shape("/collision_time", shape_);
    expect_steps("/collision_time");
    for (const char* path : {"/delay", "/trigger"}) {
      file_.expect_shape(path, with_partition);
      expect_steps(path);
    }
  }

  void read_network(const NetworkSpec& network) {
    const std::vector<std::string> names = file_.texts(paths::kMode);
    const auto same = [](const std::string& name, const NetworkModeSpec& mode) { return name == mode.name; };
    if (!std::equal(names.begin(), names.end(), network.modes.begin(), network.modes.end(), same))
      fail("the modes are not those of the spec", paths::kMode);
    Shape shape = shape_;
    shape.insert(shape.begin(), names.size());
    file_.expect_shape(paths::kNetworkSafe, shape);
    expect_type(paths::kNetworkSafe, ElementType::uint8);
    parts_.attributes.network_cells = file_.naturals(paths::kNetworkSafe, "cells");
    if (parts_.attributes.network_cells.size() != names.size())
      fail("the attribute cells does not hold a number a mode", paths::kNetworkSafe);
  }

  /// The pairs of agents, as they are numbered in the file.
  [[nodiscard]] std::vector<std::string> pair_names() const {
    const auto agents = static_cast<std::int32_t>(parts_.spec.agents.size());
    std::vector<std::string> names;
    for (std::int32_t a = 0; a < agents; ++a) {
      for (std::int32_t b = a + 1; b < agents; ++b) names.push_back(class_name(parts_.spec.agents, {a, b}));
    }
    return names;
  }

  /// The attribute `cells`, if it is there.
  [[nodiscard]] std::vector<std::int64_t> counts(const std::string& path, std::size_t size) const {
    return file_.has(path, "cells") ? file_.integers(path, "cells", size) : std::vector<std::int64_t>();
  }

  void read_coalitions() {
    file_.expect_shape(paths::kCoalition, shape_);
    expect_steps(paths::kCoalition);
    parts_.attributes.coalition_cells = counts(paths::kCoalition, parts_.partitions.size());
    parts_.pairs = pair_names();
    if (parts_.pairs.empty()) return;
    if (file_.texts(paths::kPair) != parts_.pairs)
      fail("the pairs are not those of the agents", paths::kPair);
    Shape shape = shape_;
    shape.insert(shape.begin(), parts_.pairs.size());
    file_.expect_shape(paths::kCriticalPair, shape);
    expect_type(paths::kCriticalPair, ElementType::uint8);
    parts_.attributes.critical_pair_cells = counts(paths::kCriticalPair, parts_.pairs.size());
  }

  void check_bits(const std::string& path, std::int64_t actions) const {
    Shape shape = shape_;
    shape.push_back(static_cast<std::uint64_t>((actions + 7) / 8));
    file_.expect_shape(path, shape);
    expect_type(path, ElementType::uint8);
    const std::int64_t stored = file_.integer(path, "actions");
    if (stored != actions) {
      fail("the attribute actions is " + std::to_string(stored) + ", expected " + std::to_string(actions),
           path);
    }
  }

  void check_convention() const {
    const std::vector<AgentSpec>& agents = parts_.spec.agents;
    const std::vector<std::string> names = file_.texts(paths::kAgent);
    const auto same = [](const std::string& name, const AgentSpec& agent) { return name == agent.name; };
    if (!std::equal(names.begin(), names.end(), agents.begin(), agents.end(), same))
      fail("the agents are not those of the spec", paths::kAgent);
    Shape shape = shape_;
    shape.insert(shape.begin(), agents.size());
    file_.expect_shape(paths::kConventionFreedom, shape);
    expect_type(paths::kConventionFreedom, ElementType::float32);
    if (!file_.exists(paths::kConvention)) return;
    for (const AgentSpec& agent : agents)
      check_bits(paths::convention(agent.name), joint_actions(agent.inputs));
  }

  /// What is stored of a partition on request.
  void check_extras(std::size_t p) const {
    const StoredPartition& partition = parts_.partitions[p];
    if (file_.exists(paths::actions(partition))) {
      for (std::size_t c = 0; c < partition.classes.size(); ++c) {
        check_bits(paths::actions(partition, c), partition.actions[c]);
      }
    }
    if (!file_.exists(paths::layers(partition))) return;
    const std::string start = paths::layers(partition) + "/start";
    const std::string cell = paths::layers(partition) + "/cell";
    expect_type(start, ElementType::uint64);
    file_.expect_shape(start, {partition.layer_sizes.size() + 1});
    const ElementType type = file_.element_type(cell);
    if (type != ElementType::uint32) expect_type(cell, ElementType::uint64);
    if (file_.shape(cell).size() != 1 || file_.shape(cell).front() > cells_)
      fail("not a list of cells", cell);
  }

  void read_requirements() {
    const ProblemSpec& spec = parts_.spec;
    std::vector<std::string> states, inputs;
    for (const StateSpec& state : spec.states) states.push_back(state.name);
    for (const InputSpec& input : spec.inputs) inputs.push_back(input.name);
    parts_.requirements = read_stored_requirements(file_, states, inputs);
    const auto same = [](const ResultRequirement& a, const RequirementSpec& b) { return a.name == b.name; };
    if (!std::equal(parts_.requirements.begin(), parts_.requirements.end(), spec.requirements.begin(),
                    spec.requirements.end(), same)) {
      fail("the requirements are not those of the spec", paths::kRequirements);
    }
    for (const ResultRequirement& requirement : parts_.requirements) {
      if (!requirement.path) continue;
      const auto& cells = requirement.path->cell;
      if (*std::max_element(cells.begin(), cells.end()) >= cells_)
        fail("a cell that the grid does not have", paths::kRequirements);
    }
  }

  void read_tables() {
    for (const StateSpec& state : parts_.spec.states) {
      TransitionTable& table = parts_.tables.emplace_back();
      const std::string first = paths::abstraction(state.name, "first");
      const Shape shape = add_dependencies(first, table);
      for (const char* end : {"first", "last"}) {
        const std::string path = paths::abstraction(state.name, end);
        file_.expect_shape(path, shape);
        expect_type(path, ElementType::int32);
      }
    }
  }

  /// Ascending states, then ascending inputs. @returns the shape that they mean
  Shape add_dependencies(const std::string& path, TransitionTable& table) const {
    Shape shape;
    const std::size_t rank = file_.shape(path).size();
    const auto axes = rank == 0 ? std::vector<std::string>() : file_.axes(path);
    std::size_t found = 0;
    for (std::size_t i = 0; i < parts_.spec.states.size() && found < axes.size(); ++i) {
      if (parts_.spec.states[i].name != axes[found]) continue;
      table.states.push_back(static_cast<std::int32_t>(i));
      shape.push_back(shape_[i]);
      ++found;
    }
    for (std::size_t i = 0; i < parts_.spec.inputs.size() && found < axes.size(); ++i) {
      if (parts_.spec.inputs[i].name != axes[found]) continue;
      table.inputs.push_back(static_cast<std::int32_t>(i));
      shape.push_back(parts_.spec.inputs[i].values.size());
      ++found;
    }
    if (found < axes.size()) fail("the axes are not states and inputs in the order of the spec", path);
    return shape;
  }

  ResultsFile file_;
  ResultsParts parts_;
  Shape shape_;  // of an array over all cells
  std::uint64_t cells_ = 1;
};

}  // namespace

ResultsParts read_parts(const std::string& path) {
  const auto read = [&path] { return reading(path, [&path] { return PartsReader(path).read(); }); };
  try_in_child(path, [&read] { static_cast<void>(read()); });
  return read();
}

}  // namespace coordreq
