#pragma once

#include <string>

#include "app/options.hpp"
#include "verify/verify.hpp"

namespace coordreq {

/// Prints what `verify` has found, and a line of warning where nothing is wrong but something is not
/// confirmed. @param seconds wall time; @param path of the results file
void print_verification(const CommonOptions& asked, const Verification& result, const std::string& path,
                        double seconds, int threads);

}  // namespace coordreq
