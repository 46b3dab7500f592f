#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace coordreq {

/// Keys keep the order in which they are set.
using Json = nlohmann::ordered_json;

/// The document indented by two, ending in a newline. File names may hold bytes that are not UTF-8: those
/// become U+FFFD.
[[nodiscard]] inline std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace coordreq
