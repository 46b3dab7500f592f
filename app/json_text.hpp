#pragma once

#include <string>

#include "base/json.hpp"

namespace coordreq {

/// The document indented by two, ending in a newline. File names may hold bytes that are not UTF-8: those
/// become U+FFFD.
[[nodiscard]] std::string json_text(const Json& json);
/// json_text() on one line.
[[nodiscard]] std::string json_line(const Json& json);

}  // namespace coordreq
