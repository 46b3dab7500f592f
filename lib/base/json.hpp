#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

// Parsing and writing, which take a compiler long, are compiled once.
namespace coordreq {

/// Keys keep the order in which they are set.
using Json = nlohmann::ordered_json;
/// Keys are sorted, so that one among many is soon found.
using SortedJson = nlohmann::json;

enum class JsonComments { none, skipped };

/// The value of a text in UTF-8.
/// @throws Json::parse_error for what is no JSON
[[nodiscard]] Json parse_json(std::string_view text, JsonComments comments = JsonComments::none);
/// The same; a discarded value for what is no JSON.
[[nodiscard]] Json parse_json_if_valid(std::string_view text);
[[nodiscard]] bool is_json(std::string_view text, JsonComments comments = JsonComments::none);

/// The integer under a key of an object; 0 if there is none.
[[nodiscard]] std::int64_t integer_or_zero(const Json& object, const char* key);

/// On one line, without an end of line. File names may hold bytes that are not UTF-8: those become U+FFFD.
[[nodiscard]] std::string compact_json(const Json& json);
/// compact_json() and an end of line.
[[nodiscard]] std::string json_line(const Json& json);
/// The same indented by two.
[[nodiscard]] std::string json_text(const Json& json);

}  // namespace coordreq
