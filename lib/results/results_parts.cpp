#include "results/results_parts.hpp"

#include <algorithm>

#include "answers/coalition/fields.hpp"
#include "answers/convention/fields.hpp"
#include "answers/field_parts.hpp"
#include "answers/field_table.hpp"
#include "answers/invariance/fields.hpp"
#include "answers/layers/fields.hpp"
#include "answers/network/fields.hpp"
#include "answers/requirements/fields.hpp"
#include "base/error.hpp"
#include "results/check_fields.hpp"
#include "results/results_file.hpp"
#include "results/sha256.hpp"
#include "spec/partition_names.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// Reads and checks part by part; each function throws ResultsError naming the object.
class PartsReader {
 public:
  PartsReader(const ResultsFile& file, std::optional<std::uint64_t> max_memory)
      : file_(file), max_memory_(max_memory) {}

  ResultsParts read() {
    read_header();
    read_spec_text();
    parts_.fields = checked_fields(file_, parts_.spec, max_memory_);
    read_found();
    read_partitions();
    parts_.requirements = read_requirement_values(parts_.spec, SmallFields(file_, parts_.fields));
    if (parts_.spec.output.abstraction) read_tables();
    if (parts_.spec.coordination.horizon) parts_.pairs = pair_names(parts_.spec);
    return std::move(parts_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& object) const {
    throw ResultsError(what, file_.place(object));
  }

  void read_header() {
    StoredAttributes& attributes = parts_.attributes;
    attributes.title = file_.text("/", "title");
    attributes.conventions = file_.text("/", "Conventions");
    attributes.coordreq_version = file_.text("/", "coordreq_version");
    attributes.git_sha1 = file_.text("/", "git_sha1");
    attributes.spec_sha256 = file_.text("/", "spec_sha256");
    attributes.guarantee = file_.text("/", "guarantee");
    attributes.period = file_.number("/", "period");
    attributes.period_unit = file_.text("/", "period_unit");
  }

  void read_spec_text() {
    file_.expect_array("/spec", {}, {});
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

  /// What the analysis has counted.
  void read_found() {
    const ProblemSpec& spec = parts_.spec;
    StoredAttributes& attributes = parts_.attributes;
    attributes.safe_cells = file_.natural("/safe", "cells");
    attributes.invariant_cells = file_.natural("/invariant", "cells");
    attributes.iterations = file_.integer("/collision_time", "iterations");
    attributes.connection_delay = file_.integer("/trigger", "connection_delay");
    if (spec.controller.file) attributes.controller_sha256 = file_.text(paths::kListed, "sha256");
    const std::vector<std::uint64_t> given = counted(paths::kCoalition);
    const std::vector<std::uint64_t> critical = counted(paths::kCriticalPair);
    attributes.coalition_cells.assign(given.begin(), given.end());
    attributes.critical_pair_cells.assign(critical.begin(), critical.end());
    attributes.network_cells = counted(paths::kNetworkSafe);
    if (spec.network && attributes.network_cells.size() != spec.network->modes.size())
      fail("the attribute cells does not hold a number a mode", paths::kNetworkSafe);
  }

  /// The attribute `cells`; empty where the field, or the attribute, is not in the file.
  [[nodiscard]] std::vector<std::uint64_t> counted(const std::string& path) const {
    const auto field = std::find_if(parts_.fields.begin(), parts_.fields.end(),
                                    [&path](const Field& one) { return one.path == path; });
    if (field == parts_.fields.end()) return {};
    for (const FieldAttribute& attribute : field->attributes) {
      const auto* const list = std::get_if<std::vector<std::uint64_t>>(&attribute.value);
      if (attribute.name == "cells" && list != nullptr && !list->empty() && file_.has(path, "cells"))
        return file_.naturals(path, attribute.name, list->size());
    }
    return {};
  }

  void read_partitions() {
    const SmallFields source(file_, parts_.fields);
    const std::vector<std::int64_t> sizes = source.integers("/layer_size");
    const std::vector<std::int64_t> fixed_points = source.integers("/fixed_point_index");
    const auto layers = static_cast<std::ptrdiff_t>(file_.shape("/layer").front());
    auto row = sizes.begin();
    const std::vector<PartitionSpec>& partitions = parts_.spec.coordination.partitions;
    for (std::size_t p = 0; p < partitions.size(); ++p, row += layers)
      add_partition(partitions[p], fixed_points[p], {row, row + layers});
  }

  void add_partition(const PartitionSpec& spec, std::int64_t fixed_point, std::vector<std::int64_t> sizes) {
    StoredPartition& partition = parts_.partitions.emplace_back();
    partition.name = spec.name;
    for (const auto& agents : spec.classes) {
      partition.classes.push_back(class_name(parts_.spec.agents, agents));
      partition.actions.push_back(joint_actions(parts_.spec, inputs_of(parts_.spec, agents)));
    }
    if (fixed_point >= static_cast<std::int64_t>(sizes.size()))
      fail("found " + std::to_string(fixed_point) + ", expected a layer or -1", "/fixed_point_index");
    partition.fixed_point_index = static_cast<std::int32_t>(fixed_point);
    partition.padded_sizes.assign(sizes.begin(), sizes.end());
    if (fixed_point >= 0) sizes.resize(static_cast<std::size_t>(fixed_point) + 1);
    partition.layer_sizes.assign(sizes.begin(), sizes.end());
    if (parts_.spec.output.layers)
      file_.expect_shape(paths::layers(spec) + "/start", {partition.layer_sizes.size() + 1});
  }

  /// Of each state, from the axes that its table has.
  void read_tables() {
    const ProblemSpec& spec = parts_.spec;
    for (const Field& field : parts_.fields) {
      if (field.section != FieldSection::abstraction || !field.path.ends_with("/first")) continue;
      TransitionTable& table = parts_.tables.emplace_back();
      const auto is_axis = [&field](const std::string& name) {
        return std::find(field.axes.begin(), field.axes.end(), "/" + name) != field.axes.end();
      };
      for (std::size_t i = 0; i < spec.states.size(); ++i) {
        if (is_axis(spec.states[i].name)) table.states.push_back(static_cast<std::int32_t>(i));
      }
      for (std::size_t i = 0; i < spec.inputs.size(); ++i) {
        if (is_axis(spec.inputs[i].name)) table.inputs.push_back(static_cast<std::int32_t>(i));
      }
    }
  }

  const ResultsFile& file_;
  std::optional<std::uint64_t> max_memory_;
  ResultsParts parts_;
};

}  // namespace

ResultsParts read_parts(const ResultsFile& file, std::optional<std::uint64_t> max_memory) {
  return PartsReader(file, max_memory).read();
}

}  // namespace coordreq
