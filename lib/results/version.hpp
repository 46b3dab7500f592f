#pragma once

#include <array>
#include <cstdint>
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

}  // namespace coordreq
