#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace coordreq {

/// Version of this program, "MAJOR.MINOR.PATCH".
[[nodiscard]] std::string_view program_version();

/// SHA-1 of the git commit the program was built from, 40 hexadecimal digits; "unknown" outside git.
[[nodiscard]] std::string_view program_git_sha1();

/// Version of the results format, {major, minor}: the minor grows with new data, the major when what is there
/// changes its meaning.
inline constexpr std::array<std::int32_t, 2> kResultsVersion = {1, 0};

/// Attribute `filetype` of a results file.
inline constexpr std::string_view kResultsFiletype = "coordreq-results";

/// The SHA-256 of the spec that a results file says it is of; nothing if the file is no results file of a
/// version that this program reads, or is damaged. @throws IoError if it cannot be read
[[nodiscard]] std::optional<std::string> spec_digest_of(const std::string& path);

}  // namespace coordreq
