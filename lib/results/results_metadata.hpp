#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "answers/field.hpp"
#include "answers/layers/stored_partition.hpp"
#include "reach/abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

class ResultsFile;

/// The attributes of a results file, as stored; contract section 4.
struct StoredAttributes {
  std::string title, conventions, coordreq_version, git_sha1, spec_sha256, guarantee, period_unit;
  double period = 0;
  std::uint64_t safe_cells = 0, invariant_cells = 0;  ///< attributes `cells`
  std::int64_t iterations = 0;
  std::int64_t connection_delay = 0;
  std::string controller_sha256;  ///< of `controller.file`; empty if the spec has none
};

/// Everything in a results file but the arrays of cells.
struct ResultsMetadata {
  ProblemSpec spec;
  Fields fields;  ///< that the file has
  StoredAttributes attributes;
  std::vector<StoredPartition> partitions;  ///< as many as the spec has, in its order
  /// Attributes `cells`, by path; none where they are too many.
  std::map<std::string, std::vector<std::uint64_t>> counted;
  std::vector<TransitionTable> tables;  ///< without entries; none unless stored
};

/// Reads them, and checks that the arrays are there, have their shapes and types, and that grid points,
/// partitions and digest fit the spec (see checked_fields()).
/// @pre unchecked: it was tried in a child process first (see try_in_child()). @throws hdf5::Failure; as
/// ResultsReader::ResultsReader()
[[nodiscard]] ResultsMetadata read_metadata(const ResultsFile& file, std::optional<std::uint64_t> max_memory);

}  // namespace coordreq
