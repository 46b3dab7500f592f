#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace coordreq {

/// Keys keep the order in which they are set.
using Json = nlohmann::ordered_json;

/// The document indented by two, ending in a newline. File names may hold bytes that are not UTF-8: those
/// become U+FFFD.
[[nodiscard]] std::string json_text(const Json& json);
/// The same on one line.
[[nodiscard]] std::string json_line(const Json& json);

}  // namespace coordreq
