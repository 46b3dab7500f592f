#include "verify/verify_file.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "answers/paths.hpp"
#include "answers/step_codes.hpp"
#include "base/error.hpp"
#include "results/results_reader.hpp"
#include "results/version.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

static_assert(kUnbounded == kUnbounded);

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

void read_attributes(const ResultsReader& results, const Field& field, FieldClaims& claims) {
  claims.cells = results.counted(field.path);
  for (const FieldAttribute& attribute : field.attributes) {
    if (!attribute.is_computed || attribute.name == "cells") continue;
    if (std::holds_alternative<double>(attribute.value)) {
      claims.real_attributes[attribute.name] = results.number(field.path, attribute.name);
    } else if (!std::holds_alternative<std::string>(attribute.value)) {
      claims.whole_attributes[attribute.name] = results.attribute(field.path, attribute.name);
    }
  }
}

/// Numbers that cannot be negative are those of lists, which are taken as they are.
void read_small(const ResultsReader& results, const Field& field, FieldClaims& claims) {
  const ElementType type = field.types.front();
  if (type == ElementType::float32 || type == ElementType::float64) {
    claims.numbers = results.numbers(field.path);
  } else if (type == ElementType::int16 || type == ElementType::int32 || type == ElementType::int64) {
    claims.integers = results.integers(field.path);
  } else {
    const std::vector<std::uint64_t> list = results.list(field.path);
    claims.integers.assign(list.begin(), list.end());
  }
}

FieldClaims read_field(const ResultsReader& results, const Field& field, const CellBlock& all) {
  FieldClaims claims;
  read_attributes(results, field, claims);
  const std::size_t length = results.leading_length(field);
  for (std::size_t entry = 0; entry < std::max<std::size_t>(length, 1); ++entry) {
    const ResultsReader::Leading leading = length == 0 ? std::nullopt : std::optional(entry);
    switch (field.kind) {
      case FieldKind::steps:
      case FieldKind::choice:
        claims.values.push_back(results.values(field, leading, all));
        break;
      case FieldKind::set:
        claims.members.push_back(results.members(field, leading, all));
        break;
      case FieldKind::share:
      case FieldKind::probability:
        claims.reals.push_back(results.reals(field, leading, all));
        break;
      case FieldKind::actions:
        claims.bits = results.bits(field, all);
        break;
      case FieldKind::none:
        read_small(results, field, claims);
    }
  }
  return claims;
}

/// All fields but the abstraction.
Claims read_all(const ResultsReader& results) {
  const CellBlock all = all_cells(results.grid());
  Claims claims;
  claims.file = results.path();
  claims.same_version = results.attributes().coordreq_version == program_version();
  for (const Field& field : results.fields()) {
    if (field.section == FieldSection::abstraction) continue;
    claims.fields[field.path] = field.scale ? FieldClaims() : read_field(results, field, all);
  }
  if (results.spec().controller.file)
    claims.listed = {.inputs = results.inputs().count(),
                     .bytes = std::move(claims.fields.at(paths::kListed).bits)};
  if (results.has_abstraction()) claims.abstraction = stored_tables(results);
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
