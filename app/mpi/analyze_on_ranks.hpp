#pragma once

#include <functional>

#include "base/error.hpp"
#include "ranks/ranks.hpp"

namespace coordreq {

/// `coordreq-mpi`: what is typed, done by all ranks together. Only the first reads the spec, writes, and
/// prints. @param watch is called again and again while the work goes on; what it throws ends it
/// @throws UsageError and as analyze_with_progress()
[[nodiscard]] ExitCode analyze_on_ranks(int argc, const char* const* argv, Ranks& ranks,
                                        const std::function<void()>& watch);

}  // namespace coordreq
