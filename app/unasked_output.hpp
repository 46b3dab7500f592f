#pragma once

#include <string>

#include "spec/spec_types.hpp"

// Files under names that no user has typed: what lies there may be something else that is still wanted.
namespace coordreq {

/// @throws UsageError if there is a file that does not hold results of this very spec
void check_replaces_own_results(const std::string& path, const ProblemSpec& spec);

/// @param spec_sha256 of the results that the report is of
/// @throws UsageError if there is a file that is no report on results of this very spec
void check_replaces_own_report(const std::string& path, const std::string& spec_sha256);

}  // namespace coordreq
