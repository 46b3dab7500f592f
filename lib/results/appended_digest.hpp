#pragma once

#include <optional>
#include <string>
#include <string_view>

// The SHA-256 of a file behind what it is of, so that a byte that is damaged or missing anywhere shows.
namespace coordreq {

/// @param where named in errors @returns the digest. @throws IoError
std::string append_digest(const std::string& path, const std::string& where);

/// The digest at the end: empty if it is not that of what is before, nothing if there is none or the file
/// does not begin with `signature`.
/// @throws IoError if it cannot be read
[[nodiscard]] std::optional<std::string> checked_digest(const std::string& path, std::string_view signature);

}  // namespace coordreq
