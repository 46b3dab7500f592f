#include "expression/place.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/requires.hpp"

namespace coordreq {
namespace {

bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// ASCII, and no control character but white space.
[[maybe_unused]] bool is_quotable(char c) {
  return (' ' <= c && c <= '~') || ('\t' <= c && c <= '\r');
}

unsigned lead_size(unsigned char lead) {
  if (lead < 0x80U) return 1;
  if (lead >= 0xC2U && lead < 0xE0U) return 2;
  if (lead >= 0xE0U && lead < 0xF0U) return 3;
  if (lead >= 0xF0U && lead < 0xF5U) return 4;
  return 0;
}

}  // namespace

std::string SourceText::at(std::size_t offset) const {
  const std::string_view before = text.substr(0, offset);
  const auto lines = std::count(before.begin(), before.end(), '\n');
  const std::size_t line_end = before.rfind('\n');
  const std::string_view line = line_end == std::string_view::npos ? before : before.substr(line_end + 1);
  const auto column = 1 + std::count_if(line.begin(), line.end(), [](char c) { return !is_continuation(c); });
  const std::string_view comma = where.empty() ? "" : ", ";
  if (text.find('\n') == std::string_view::npos) return fmt::format("{}{}column {}", where, comma, column);
  return fmt::format("{}{}line {}, column {}", where, comma, lines + 1, column);
}

void SourceText::fail(std::string_view what, std::size_t offset) const {
  throw SpecError(what, at(offset));
}

std::string in_quotes(std::string_view text) {
  REQUIRES(std::ranges::all_of(text, is_quotable));
  constexpr std::size_t kMost = 40;
  const std::string_view dots = text.size() > kMost ? "..." : "";
  std::string shortened(text.substr(0, kMost));
  // An error is one line, whatever white space the expression has.
  std::replace_if(
      shortened.begin(), shortened.end(), [](char c) { return c < ' '; }, ' ');
  return fmt::format("'{}{}'", shortened, dots);
}

std::size_t code_point_size(std::string_view text) {
  REQUIRES(!text.empty());
  const std::size_t size = lead_size(static_cast<unsigned char>(text.front()));
  if (size == 0 || size > text.size()) return 1;
  const std::string_view rest = text.substr(1, size - 1);
  return std::all_of(rest.begin(), rest.end(), is_continuation) ? size : 1;
}

std::string character_text(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t size = code_point_size(text);
  if (size == 1 && lead >= 0x80U) return fmt::format("byte 0x{:02X}", lead);
  if (size == 1 && lead >= 0x20U && lead < 0x7FU) return fmt::format("'{}'", text.front());
  // The lead byte of n > 1 bytes carries 7 - n bits, each continuation byte 6.
  std::uint32_t code = size == 1 ? lead : lead & ((1U << (7U - size)) - 1U);
  for (const char c : text.substr(1, size - 1)) code = (code << 6U) | (static_cast<unsigned char>(c) & 0x3FU);
  return fmt::format("U+{:04X}", code);
}

}  // namespace coordreq
