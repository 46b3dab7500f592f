#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/tally.hpp"
#include "answers/field.hpp"
#include "base/process_memory.hpp"
#include "results/results_reader.hpp"
#include "results/stored_object.hpp"
#include "spec/problem_spec.hpp"
#include "spec/spec_types.hpp"
#include "verify/verify.hpp"

namespace coordreq {

/// The attributes and axes that these fields of a results file of this spec have to have (contract, section
/// 4), but for free text, provenance and what counts cells or sweeps, which the checks of the answers look
/// after.
[[nodiscard]] std::vector<StoredObject> expected_objects(const ProblemSpec& spec, const Fields& fields);

/// Compares what is there with what is expected; more attributes than those are no harm.
[[nodiscard]] Finding check_objects(const std::vector<StoredObject>& expected,
                                    const std::vector<StoredObject>& found);

/// Memory of verifying a results file, in bytes.
struct VerifyMemory {
  double claims = 0;  ///< what the file says of all cells, with a copy of an array while it is read
  MemoryDemand work;  ///< posts of all cells, what is kept of each, and of a thread what it knows of one cell
};
[[nodiscard]] VerifyMemory verify_memory(const ResultsReader& results);

/// A results file in memory, ready to be doubted.
struct ClaimedFile {
  ProblemSpec spec;
  Claims claims;
  Finding attributes;
  MemoryDemand demand = {};  ///< of what is to be done
};

/// Reads a results file whole. Starts no thread, and must be called before any is (see try_in_child()).
/// @throws IoError, ResultsError as ResultsReader does; SpecError if its spec needs what this version cannot
/// do;
///   LimitError if verifying takes more than `max_memory` bytes
[[nodiscard]] ClaimedFile read_claims(const std::string& path, std::optional<std::uint64_t> max_memory);

/// verify_claims() and the attributes of the file.
[[nodiscard]] Verification verify_file(const ClaimedFile& file, const VerifyOptions& options,
                                       ThreadTeam& team);

}  // namespace coordreq
