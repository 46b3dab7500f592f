#include "spec/json_span.hpp"

#include <nlohmann/json.hpp>

namespace coordreq {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// The first byte from `i` on that is neither blank nor in a comment.
std::size_t skip_blanks(std::string_view text, std::size_t i) {
  while (i < text.size()) {
    if (is_blank(text[i])) {
      ++i;
    } else if (text.substr(i, 2) == "//") {
      i = text.find('\n', i);
    } else if (text.substr(i, 2) == "/*") {
      i = text.find("*/", i + 2) + 2;
    } else {
      break;
    }
  }
  return i;
}

/// Behind the closing quote of the string at `i`.
std::size_t skip_string(std::string_view text, std::size_t i) {
  for (++i; text[i] != '"'; ++i) {
    if (text[i] == '\\') ++i;
  }
  return i + 1;
}

/// Behind the value at `i`.
std::size_t skip_value(std::string_view text, std::size_t i) {
  if (text[i] == '"') return skip_string(text, i);
  if (text[i] != '{' && text[i] != '[') {
    const std::size_t end = text.find_first_of(" \t\n\r,]}/", i);
    return end == std::string_view::npos ? text.size() : end;
  }
  for (std::size_t depth = 0;;) {
    const char c = text[i];
    if (c == '{' || c == '[') ++depth;
    if ((c == '}' || c == ']') && --depth == 0) return i + 1;
    i = skip_blanks(text, c == '"' ? skip_string(text, i) : i + 1);
  }
}

}  // namespace

JsonSpan root_span(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  const bool marked = text.substr(0, kByteOrderMark.size()) == kByteOrderMark;
  const std::size_t begin = skip_blanks(text, marked ? kByteOrderMark.size() : 0);
  return {begin, skip_value(text, begin)};
}

std::vector<JsonMember> member_spans(std::string_view text, JsonSpan object) {
  std::vector<JsonMember> members;
  for (std::size_t i = skip_blanks(text, object.begin + 1); text[i] != '}';) {
    const std::size_t key_end = skip_string(text, i);
    const std::string_view key = text.substr(i, key_end - i);
    const std::size_t colon = skip_blanks(text, key_end);
    const std::size_t begin = skip_blanks(text, colon + 1);
    const std::size_t end = skip_value(text, begin);
    members.push_back({nlohmann::json::parse(key).get<std::string>(), {begin, end}});
    i = skip_blanks(text, end);
    if (text[i] == ',') i = skip_blanks(text, i + 1);
  }
  return members;
}

std::vector<JsonSpan> element_spans(std::string_view text, JsonSpan list) {
  std::vector<JsonSpan> elements;
  for (std::size_t i = skip_blanks(text, list.begin + 1); text[i] != ']';) {
    elements.push_back({i, skip_value(text, i)});
    i = skip_blanks(text, elements.back().end);
    if (text[i] == ',') i = skip_blanks(text, i + 1);
  }
  return elements;
}

}  // namespace coordreq
