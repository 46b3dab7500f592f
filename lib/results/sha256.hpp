#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace coordreq {

/// SHA-256 (FIPS 180-4) of the bytes of `text`, as 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256_hex(std::string_view text);

/// The same of the bytes of a file. @param left_out so many at its end
/// @throws IoError
[[nodiscard]] std::string sha256_of_file(const std::string& path, std::uint64_t left_out = 0);

}  // namespace coordreq
