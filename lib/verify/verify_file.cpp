#include "verify/verify_file.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "answers/coalition/fields.hpp"
#include "answers/convention/fields.hpp"
#include "answers/field_parts.hpp"
#include "answers/invariance/fields.hpp"
#include "answers/layers/fields.hpp"
#include "answers/network/fields.hpp"
#include "base/error.hpp"
#include "results/results_reader.hpp"
#include "results/version.hpp"
#include "spec/problem_spec.hpp"
#include "spec/read_spec.hpp"
#include "verify/verify_memory.hpp"

namespace coordreq {
namespace {

static_assert(ResultsReader::kNever == kForever);

std::vector<std::size_t> indices(const std::vector<std::int32_t>& numbers) {
  return {numbers.begin(), numbers.end()};
}

std::vector<PostTable> stored_tables(const ResultsReader& results) {
  std::vector<PostTable> tables;
  Abstraction abstraction = results.abstraction();
  for (TransitionTable& table : abstraction.tables) {
    tables.push_back({.states = indices(table.states),
                      .inputs = indices(table.inputs),
                      .entries = std::move(table.entries),
                      .state_stride = table.state_stride,
                      .input_stride = table.input_stride,
                      .exact = false});
  }
  return tables;
}

PartitionClaims read_partition(const ResultsReader& results, std::size_t p, const CellBlock& all) {
  const ProblemSpec& spec = results.spec();
  const StoredPartition& stored = results.partitions()[p];
  PartitionClaims claims{.name = stored.name,
                         .delay = results.values(paths::kDelay, p, all),
                         .trigger = results.values(paths::kTrigger, p, all),
                         .fixed_point_index = stored.fixed_point_index,
                         .layer_sizes = stored.padded_sizes,
                         .has_layers = spec.output.layers};
  const PartitionSpec& partition = spec.coordination.partitions[p];
  for (std::size_t c = 0; spec.output.actions && c < stored.classes.size(); ++c)
    claims.actions.push_back(results.bits(paths::actions(spec, partition, c), all));
  if (claims.has_layers) {
    StoredLayers layers = read_layer_lists(spec, partition, results);
    claims.layer_start = std::move(layers.start);
    claims.layer_cell = std::move(layers.cell);
  }
  return claims;
}

void read_coalition(const ResultsReader& results, const CellBlock& all, Claims& claims) {
  const std::vector<std::uint64_t> given = results.counted(paths::kCoalition);
  const std::vector<std::uint64_t> critical = results.counted(paths::kCriticalPair);
  claims.coalition_cells.assign(given.begin(), given.end());
  claims.pairs = pair_names(results.spec());
  claims.critical_pair_cells.assign(critical.begin(), critical.end());
  for (std::size_t pair = 0; pair < claims.pairs.size(); ++pair)
    claims.critical_pairs.push_back(results.members(results.field(paths::kCriticalPair), pair, all));
}

/// Fields of numbers over cells alone that have no member in Claims.
std::vector<const Field*> plain_numbers(const ResultsReader& results) {
  const std::set<std::string> known = {"/safe", "/invariant", "/collision_time"};
  const std::vector<std::string> axes = cell_axes(results.spec());
  std::vector<const Field*> fields;
  for (const Field& field : results.fields()) {
    const bool integers = !field.types.empty() && field.types.front() != ElementType::float32;
    if (integers && field.axes == axes && !known.contains(field.path)) fields.push_back(&field);
  }
  return fields;
}

/// Fields of bits over cells that have no member in Claims.
std::vector<const Field*> plain_bits(const ResultsReader& results) {
  std::vector<std::string> known = {paths::kController, paths::kListed};
  const ProblemSpec& spec = results.spec();
  for (const AgentSpec& agent : spec.agents) known.push_back(paths::convention(agent));
  for (const PartitionSpec& partition : spec.coordination.partitions) {
    for (std::size_t c = 0; c < partition.classes.size(); ++c)
      known.push_back(paths::actions(spec, partition, c));
  }
  std::vector<const Field*> fields;
  for (const Field& field : results.fields()) {
    std::vector<std::string> axes = cell_axes(spec);
    axes.push_back(field.path + ":byte");
    if (field.axes == axes && std::find(known.begin(), known.end(), field.path) == known.end())
      fields.push_back(&field);
  }
  return fields;
}

void read_attributes(const ResultsReader& results, const Field& field, Claims& claims) {
  for (const FieldAttribute& attribute : field.attributes) {
    if (attribute.is_found && attribute.name != "cells")
      claims.attributes[field.path + " " + attribute.name] = results.attribute(field.path, attribute.name);
  }
}

/// Fields of numbers over partitions, and of these over cells too, that have no member in Claims.
std::vector<const Field*> partition_numbers(const ResultsReader& results) {
  const std::set<std::string> known = {"/delay", "/trigger", "/layer_size", "/fixed_point_index"};
  std::vector<const Field*> fields;
  for (const Field& field : results.fields()) {
    const bool is_of_partitions = !field.axes.empty() && field.axes.front() == "/partition";
    if (is_of_partitions && !known.contains(field.path)) fields.push_back(&field);
  }
  return fields;
}

bool is_over_cells(const Field& field, const ProblemSpec& spec) {
  return field.axes == cell_axes("/partition", spec);
}

void read_partition_numbers(const ResultsReader& results, const CellBlock& all, Claims& claims) {
  for (const Field* const field : partition_numbers(results)) {
    if (!is_over_cells(*field, results.spec())) {
      claims.lists[field->path] = results.integers(field->path);
      continue;
    }
    for (std::size_t p = 0; p < results.partitions().size(); ++p)
      claims.partition_numbers[field->path].push_back(results.values(*field, p, all));
  }
}

/// What agents may do by convention is stored.
bool has_convention(const ProblemSpec& spec) {
  return spec.coordination.convention && spec.output.actions;
}

Claims read_all(const ResultsReader& results) {
  const CellBlock all = all_cells(results.grid());
  Claims claims{.safe = results.members(paths::kSafe, all),
                .invariant = results.members(paths::kInvariant, all),
                .collision_time = results.values(paths::kCollisionTime, all),
                .has_controller = results.spec().output.controller,
                .same_version = results.attributes().coordreq_version == program_version(),
                .safe_cells = results.attributes().safe_cells,
                .invariant_cells = results.attributes().invariant_cells,
                .iterations = results.attributes().iterations};
  for (std::size_t p = 0; p < results.partitions().size(); ++p)
    claims.partitions.push_back(read_partition(results, p, all));
  for (const Field* const field : plain_numbers(results)) {
    claims.numbers[field->path] = results.values(*field, std::nullopt, all);
    read_attributes(results, *field, claims);
  }
  read_partition_numbers(results, all, claims);
  for (const Field* const field : plain_bits(results)) claims.bits[field->path] = results.bits(*field, all);
  const std::size_t modes = results.spec().network ? results.spec().network->modes.size() : 0;
  for (std::size_t mode = 0; mode < modes; ++mode)
    claims.network.push_back(results.members(results.field(paths::kNetworkSafe), mode, all));
  claims.network_cells = results.counted(paths::kNetworkSafe);
  claims.requirements = results.requirements();
  if (claims.has_controller) claims.controller = results.bits(paths::kController, all);
  if (results.spec().controller.file)
    claims.listed = {.inputs = results.inputs().count(), .bytes = results.bits(paths::kListed, all)};
  for (std::size_t i = 0; i < results.spec().agents.size(); ++i) {
    if (results.spec().coordination.convention)
      claims.convention_freedom.push_back(results.shares(results.field(paths::kConventionFreedom), i, all));
    if (has_convention(results.spec()))
      claims.convention.push_back(results.bits(paths::convention(results.spec().agents[i]), all));
  }
  if (results.has_abstraction()) claims.abstraction = stored_tables(results);
  if (results.spec().coordination.horizon) read_coalition(results, all, claims);
  return claims;
}

}  // namespace

ClaimedFile read_claims(const std::string& path, std::optional<std::uint64_t> max_memory) {
  const ResultsReader results(path, max_memory);
  const VerifyMemory memory = verify_memory(results);
  expect_memory("verifying needs",
                results.reading_bytes() + memory.claims + memory.work.once + memory.work.of_thread,
                max_memory);
  const std::vector<StoredObject> expected = expected_objects(results.spec(), results.fields());
  std::vector<std::string> paths;
  for (const StoredObject& object : expected) paths.push_back(object.path);
  Finding attributes = check_objects(expected, read_objects(path, paths));
  return {results.spec(), read_all(results), std::move(attributes), memory.work};
}

Verification verify_file(const ClaimedFile& file, const VerifyOptions& options, ThreadTeam& team) {
  Verification result = verify_claims(file.spec, file.claims, options, team);
  result.findings.insert(result.findings.begin(), file.attributes);
  return result;
}

}  // namespace coordreq
