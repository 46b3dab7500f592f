#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "answers/field.hpp"
#include "answers/layers/fields.hpp"
#include "answers/requirements/result_requirement.hpp"
#include "reach/abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// What a results file says of itself, as stored; contract section 4.
struct StoredAttributes {
  std::string title, conventions, coordreq_version, git_sha1, spec_sha256, guarantee, period_unit;
  double period = 0;
  std::uint64_t safe_cells = 0, invariant_cells = 0;  ///< attributes `cells`
  std::int64_t iterations = 0;
  std::int64_t connection_delay = 0;
  std::string controller_sha256;  ///< of `controller.file`; empty if the spec has none
};

/// /layers/PARTITION: T(k) is cell[start[k]], ..., cell[start[k + 1] - 1].
struct StoredLayers {
  std::vector<std::uint64_t> start;
  std::vector<std::uint64_t> cell;
};

class ResultsFile;

/// Everything in a results file but the arrays over cells.
struct ResultsParts {
  ProblemSpec spec;
  Fields fields;  ///< that the file has
  StoredAttributes attributes;
  std::vector<StoredPartition> partitions;  ///< as many as the spec has, in its order
  std::vector<ResultRequirement> requirements;
  /// Attributes `cells`, by path; none where they are too many.
  std::map<std::string, std::vector<std::uint64_t>> counted;
  std::vector<TransitionTable> tables;  ///< without entries; none unless stored
  std::vector<std::string> pairs;       ///< of agents, for which critical cells are stored
};

/// Reads them, and checks that the arrays are there, have their shapes and types, and that grid points,
/// partitions and digest fit the spec (see checked_fields()).
/// REQUIRES: it was tried in a child process first (see try_in_child()). @throws hdf5::Failure; as
/// ResultsReader::ResultsReader()
[[nodiscard]] ResultsParts read_parts(const ResultsFile& file, std::optional<std::uint64_t> max_memory);

}  // namespace coordreq
