#pragma once

#include <optional>
#include <string>

namespace coordreq {

/// The SHA-256 of the spec that a results file says it is of; nothing if the file is no results file of a
/// version that this program reads, or is damaged. @throws IoError if it cannot be read
[[nodiscard]] std::optional<std::string> spec_digest_of(const std::string& path);

}  // namespace coordreq
