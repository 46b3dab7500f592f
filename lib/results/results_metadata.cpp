#include "results/results_metadata.hpp"

#include <algorithm>

#include "answers/field_table.hpp"
#include "answers/paths.hpp"
#include "answers/plan.hpp"
#include "base/error.hpp"
#include "results/check_fields.hpp"
#include "results/results_file.hpp"
#include "results/sha256.hpp"
#include "spec/read_spec.hpp"
#include "spec/set_value.hpp"

namespace coordreq {
namespace {

/// Reads and checks object by object; each function throws ResultsError naming the object.
class MetadataReader {
 public:
  MetadataReader(const ResultsFile& file, std::optional<std::uint64_t> max_memory)
      : file_(file), max_memory_(max_memory) {}

  ResultsMetadata read() {
    read_header();
    read_spec_text();
    metadata_.fields = checked_fields(file_, metadata_.spec, max_memory_);
    read_found();
    const SmallFields source(file_, metadata_);
    metadata_.partitions = read_partition_values(metadata_.spec, source);
    for (const Answer& answer : all_answers()) {
      if (answer.examine != nullptr) answer.examine(metadata_.spec, source);
    }
    if (metadata_.spec.output.abstraction) read_tables();
    return std::move(metadata_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& object) const {
    throw ResultsError(what, file_.location(object));
  }

  void read_header() {
    StoredAttributes& attributes = metadata_.attributes;
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
    if (digest != metadata_.attributes.spec_sha256) {
      fail("the SHA-256 of the spec is " + digest + ", the attribute spec_sha256 says " +
               metadata_.attributes.spec_sha256,
           "/spec");
    }
    try {
      metadata_.spec = read_spec(std::move(text), "spec");
    } catch (const Error& error) {
      fail(std::string("the spec is not valid: ") + error.what(), "/spec");
    }
    check_spec_json();
  }

  /// Files of earlier versions do not have it.
  void check_spec_json() const {
    if (!file_.exists("/spec_json")) return;
    file_.expect_array("/spec_json", {}, {});
    if (file_.texts("/spec_json").front() != without_comments(metadata_.spec.text))
      fail("expected the spec without its comments, found another text", "/spec_json");
  }

  /// Reads the numbers that the analysis has counted.
  void read_found() {
    for (const Field& field : metadata_.fields) {
      for (const FieldAttribute& attribute : field.attributes) read_count(field, attribute);
    }
    StoredAttributes& attributes = metadata_.attributes;
    attributes.safe_cells = metadata_.counted.at("/safe").front();
    attributes.invariant_cells = metadata_.counted.at("/invariant").front();
    attributes.iterations = file_.integer("/collision_time", "iterations");
    attributes.connection_delay = file_.integer("/trigger", "connection_delay");
    if (metadata_.spec.controller.file) attributes.controller_sha256 = file_.text(paths::kListed, "sha256");
  }

  /// A list may be missing.
  void read_count(const Field& field, const FieldAttribute& attribute) {
    if (attribute.name != "cells") return;
    std::size_t count = 1;
    if (const auto* const list = std::get_if<std::vector<std::uint64_t>>(&attribute.value)) {
      count = list->size();
      if (count == 0 || !file_.has(field.path, "cells")) return;
    }
    metadata_.counted[field.path] = file_.naturals(field.path, "cells", count);
  }

  /// Reads the dependencies of each state, from the axes of its table.
  void read_tables() {
    const ProblemSpec& spec = metadata_.spec;
    for (const Field& field : metadata_.fields) {
      if (field.section != FieldSection::abstraction || !field.path.ends_with("/first")) continue;
      TransitionTable& table = metadata_.tables.emplace_back();
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
  ResultsMetadata metadata_;
};

}  // namespace

ResultsMetadata read_metadata(const ResultsFile& file, std::optional<std::uint64_t> max_memory) {
  return MetadataReader(file, max_memory).read();
}

}  // namespace coordreq
