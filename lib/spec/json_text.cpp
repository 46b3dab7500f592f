#include "spec/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "base/error.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

unsigned byte_at(std::string_view text, std::size_t offset) {
  return offset < text.size() ? static_cast<unsigned char>(text[offset]) : 0U;
}

bool is_continuation(unsigned byte) {
  return (byte & 0xC0U) == 0x80U;
}

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// Bytes of the well-formed UTF-8 sequence (Unicode standard, table 3-7) at `offset`, 0 if it is ill-formed.
std::size_t utf8_length(std::string_view text, std::size_t offset) {
  const unsigned first = byte_at(text, offset);
  if (first < 0x80U) return 1;
  const unsigned second = byte_at(text, offset + 1);
  if (first >= 0xC2U && first <= 0xDFU) return is_continuation(second) ? 2 : 0;
  if (first < 0xE0U || first > 0xF4U || !is_continuation(second)) return 0;
  if (!is_continuation(byte_at(text, offset + 2))) return 0;
  // Overlong forms, surrogates and code points beyond U+10FFFF.
  if ((first == 0xE0U && second < 0xA0U) || (first == 0xEDU && second > 0x9FU)) return 0;
  if (first <= 0xEFU) return 3;
  if ((first == 0xF0U && second < 0x90U) || (first == 0xF4U && second > 0x8FU)) return 0;
  return is_continuation(byte_at(text, offset + 3)) ? 4 : 0;
}

bool is_word_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
         c == '+' || c == '-' || static_cast<unsigned char>(c) >= 0x80U;
}

/// Behind the closing quote of the string at `offset`, or the end of its line.
std::size_t string_end(std::string_view text, std::size_t offset) {
  for (std::size_t i = offset + 1; i < text.size() && text[i] != '\n'; ++i) {
    if (text[i] == '"') return i + 1;
    if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] != '\n') ++i;
  }
  return std::min(text.find('\n', offset), text.size());
}

/// Behind the comment that starts at `offset`, which is `offset` if none does; nowhere if it has no end.
std::size_t comment_end(std::string_view text, std::size_t offset) {
  const std::string_view start = text.substr(offset, 2);
  if (start == "//") return std::min(text.find('\n', offset), text.size());
  if (start != "/*") return offset;
  const std::size_t end = text.find("*/", offset + 2);
  return end == std::string_view::npos ? end : end + 2;
}

/// Behind the comments that start at `offset`, one right after the other.
std::size_t after_comments(std::string_view text, std::size_t offset) {
  for (std::size_t before = text.size(); offset != before && offset < text.size();) {
    before = offset;
    offset = std::min(comment_end(text, offset), text.size());
  }
  return offset;
}

std::size_t token_end(std::string_view text, std::size_t offset) {
  if (offset >= text.size()) return text.size();
  if (text[offset] == '"') return string_end(text, offset);
  const auto* const end =
      std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(offset), text.end(), is_word_character);
  return std::max(offset + 1, static_cast<std::size_t>(end - text.begin()));
}

}  // namespace

std::string JsonText::position(std::size_t offset) const {
  const std::string_view before = text.substr(0, offset);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  std::size_t column = 1;
  for (const char c : before.substr(line_start))
    column += is_continuation(static_cast<unsigned char>(c)) ? 0U : 1U;
  return fmt::format("line {}, column {}", line, column);
}

std::string JsonText::at(std::size_t offset) const {
  return fmt::format("{}, {}", source, position(offset));
}

std::string JsonText::found_at(std::size_t offset) const {
  return offset >= text.size() ? "the end of the file" : quote_text(token(offset));
}

std::string_view JsonText::token(std::size_t offset) const {
  return text.substr(std::min(offset, text.size()), token_end(text, offset) - std::min(offset, text.size()));
}

std::size_t JsonText::token_from(std::size_t offset) const {
  for (std::size_t before = text.size(); offset != before && offset < text.size();) {
    before = offset;
    while (offset < text.size() && is_space(text[offset])) ++offset;
    offset = after_comments(text, offset);
  }
  return offset;
}

std::optional<std::size_t> JsonText::open_comment() const {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = comment_end(text, i);
    if (end == std::string_view::npos) return i;
    i = end == i ? token_end(text, i) : end;
  }
  return std::nullopt;
}

std::size_t JsonText::bracket(std::size_t number) const {
  for (std::size_t i = 0; i < text.size(); i = token_end(text, i)) {
    i = after_comments(text, i);
    if (i < text.size() && (text[i] == '[' || text[i] == '{') && --number == 0) return i;
  }
  return text.size();
}

std::size_t JsonText::token_before(std::size_t offset) const {
  std::size_t last = text.size();
  const std::size_t end = std::min(offset, text.size());
  for (std::size_t i = after_comments(text, 0); i < end; i = after_comments(text, token_end(text, i))) {
    if (!is_space(text[i])) last = i;
  }
  return last;
}

void JsonText::fail(std::string_view what, std::size_t offset) const {
  throw SpecError(what, at(std::min(offset, text.size())));
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.substr(0, kMark.size()) == kMark ? text.substr(kMark.size()) : text;
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    if (length == 0) return false;
    i += length;
  }
  return true;
}

void check_encoding(const JsonText& json) {
  if (std::all_of(json.text.begin(), json.text.end(), is_space)) {
    throw SpecError("the file is empty, expected a spec", json.source);
  }
  if (json.text.starts_with("\x89HDF"))
    throw SpecError("is HDF5 as results are, expected a spec", json.source);
  for (std::size_t i = 0; i < json.text.size();) {
    const std::size_t length = utf8_length(json.text, i);
    if (length == 0) {
      json.fail(fmt::format("expected UTF-8 text, found the byte 0x{:02X}", byte_at(json.text, i)), i);
    }
    if (json.text[i] == '\0') json.fail("expected text, found a NUL byte", i);
    i += length;
  }
}

}  // namespace coordreq
