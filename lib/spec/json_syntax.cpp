#include "spec/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "base/json.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

bool is_opening_or_comma(std::string_view token) {
  return token.empty() || token == "{" || token == "[" || token == ",";
}

/// Whether no place in a document can have the token.
bool is_broken(std::string_view token) {
  constexpr std::string_view kPunctuation = "{}[]:,";
  return !token.empty() && kPunctuation.find(token[0]) == std::string_view::npos && !is_json(token);
}

/// The tokens that may follow those before `start`, in words.
std::string_view expected_at(const JsonText& json, std::size_t start, JsonLevel level) {
  const std::size_t before = json.token_before(start);
  const std::string_view last = json.token(before);
  if (last == ":") return "a value";
  if (level == JsonLevel::kOutermost) return last.empty() ? "a value" : "the end of the file";
  if (level == JsonLevel::kList) return is_opening_or_comma(last) ? "a value" : "',' or ']'";
  if (is_opening_or_comma(last)) return "a key in double quotes";
  return is_opening_or_comma(json.token(json.token_before(before))) ? "':'" : "',' or '}'";
}

/// ", did you mean 'true'?" for words of JSON in other letters and of other languages.
std::string suggested_literal(std::string_view token) {
  if (token == "None" || token == "nil") return ", did you mean 'null'?";
  if (token == "true" || token == "false" || token == "null") return "";
  return same_letters(token, {"true", "false", "null"});
}

/// @param token a string that no parser takes, `wrong` its first wrong byte
[[noreturn]] void fail_string(const JsonText& json, std::string_view token, std::size_t wrong) {
  const char found = wrong < json.text.size() ? json.text[wrong] : '\n';
  if (found == '\n') {
    const char* const end = wrong < json.text.size() ? "line" : "file";
    json.fail(fmt::format("expected '\"' at the end of a string, found the end of the {}", end), wrong);
  }
  if (static_cast<unsigned char>(found) < 0x20U) {
    const auto code = static_cast<unsigned>(found);
    json.fail(fmt::format("expected \\u{0:04X} in a string, found the character U+{0:04X} itself", code),
              wrong);
  }
  const std::size_t escape = std::min(json.text.rfind('\\', wrong), wrong);
  const std::size_t length = std::min<std::size_t>(wrong + 1 - escape, token.size());
  json.fail(fmt::format("expected an escape such as \\n, \\\\ or \\u00E9, found {}",
                        quote_text(json.text.substr(escape, length))),
            escape);
}

}  // namespace

void fail_syntax(const JsonText& json, std::size_t read, JsonLevel level) {
  // The parser may have looked at the token behind the wrong one.
  std::size_t start = json.token_before(read);
  if (const std::size_t before = json.token_before(start); is_broken(json.token(before))) start = before;
  const bool is_end = read > json.text.size() && !is_broken(json.token(start));
  if (is_end) {
    start = json.text.size();
    if (const std::optional<std::size_t> comment = json.open_comment())
      json.fail("expected '*/' at the end of this comment, found the end of the file", *comment);
  }

  const std::string_view token = json.token(start);
  if (is_broken(token) && token[0] == '"') fail_string(json, token, read - 1);
  if (is_broken(token) && (token[0] == '-' || (token[0] >= '0' && token[0] <= '9')))
    json.fail(fmt::format("expected a number such as 10, 0.5 or 1e-3, found {}", quote_text(token)), start);
  if (token == "]" || token == "}") {
    const std::size_t before = json.token_before(start);
    if (json.token(before) == ",")
      json.fail(fmt::format("expected no comma before '{}', found a trailing one", token), before);
  }
  json.fail(fmt::format("expected {}, found {}{}", expected_at(json, start, level), json.found_at(start),
                        suggested_literal(token)),
            start);
}

}  // namespace coordreq
