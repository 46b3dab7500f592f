#pragma once

#include <string>

#include "verify/verify.hpp"

namespace coordreq {

/// What `verify` prints for people. @param seconds wall time; @param path of the results file
[[nodiscard]] std::string verification_text(const Verification& result, const std::string& path,
                                            double seconds, int threads);

/// The warning of a result in which nothing is wrong but something is not confirmed: one line.
[[nodiscard]] std::string not_confirmed_line(const Verification& result, const std::string& path);

/// What `verify --json` prints: one document, keys in a fixed order, ending in a newline.
[[nodiscard]] std::string verification_json(const Verification& result, const std::string& path,
                                            double seconds, int threads);

}  // namespace coordreq
