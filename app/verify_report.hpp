#pragma once

#include <string>

#include "app/json_text.hpp"
#include "verify/verify.hpp"

namespace coordreq {

/// What `verify` has found. @param seconds wall time; @param path of the results file
[[nodiscard]] Json verification_json(const Verification& result, const std::string& path, double seconds,
                                     int threads);
/// The same in words.
[[nodiscard]] std::string verification_text(const Json& result);

/// The warning of a result in which nothing is wrong but something is not confirmed: one line.
[[nodiscard]] std::string not_confirmed_line(const Json& result);

}  // namespace coordreq
