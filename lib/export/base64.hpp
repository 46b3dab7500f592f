#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace coordreq {

/// The bytes in the letters A-Z a-z 0-9 + / and padding = (RFC 4648, section 4), without line breaks.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

}  // namespace coordreq
