#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/process_memory.hpp"
#include "spec/problem_spec.hpp"
#include "verify/expected_objects.hpp"
#include "verify/verify.hpp"

namespace coordreq {

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
