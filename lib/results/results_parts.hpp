#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "answers/field.hpp"
#include "answers/layers/stored_partition.hpp"
#include "reach/abstraction.hpp"
#include "results/stored_values.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

class ResultsFile;

/// Everything in a results file but the arrays over cells.
struct ResultsParts {
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
[[nodiscard]] ResultsParts read_parts(const ResultsFile& file, std::optional<std::uint64_t> max_memory);

}  // namespace coordreq
