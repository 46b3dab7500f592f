#include "spec/wording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace coordreq {
namespace {

constexpr std::size_t kLongestQuote = 60;

bool is_utf8_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last, last, row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last = last;
    last = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
  }
  return row.back();
}

}  // namespace

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20U || code == 0x7FU) {
      line += fmt::format("\\u{:04X}", code);
    } else {
      line += c;
    }
  }
  return line;
}

std::string quote_text(std::string_view text) {
  if (text.size() <= kLongestQuote) return "'" + one_line(text) + "'";
  std::size_t end = kLongestQuote - 3;
  // A character has no more than three of these; text that is no UTF-8 may consist of them.
  for (int n = 0; n < 3 && is_utf8_continuation(text[end]); ++n) --end;
  return "'" + one_line(text.substr(0, end)) + "...'";
}

std::string short_number(const Rational& value) {
  return fmt::format("{:.6g}", nearest_double(value));
}

std::string quote_list(const std::vector<std::string>& names, std::string_view joiner) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) list += i + 1 == names.size() ? " " + std::string(joiner) + " " : ", ";
    list += quote_text(names[i]);
  }
  return list;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& known) {
  if (const std::string same = same_letters(name, known); !same.empty()) return same;
  // No spelling mistake is longer than this, and the distance costs the product of the lengths.
  constexpr std::size_t kLongestName = 200;
  if (name.size() > kLongestName) return {};
  const std::string* best = nullptr;
  std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance && distance < candidate.size()) {
      best = &candidate;
      best_distance = distance;
    }
  }
  return best == nullptr ? std::string() : ", did you mean " + quote_text(*best) + "?";
}

std::string pointer_text(std::string_view pointer) {
  return pointer.empty() ? "top level" : one_line(pointer);
}

std::string member_pointer(std::string_view pointer, std::string_view key) {
  std::string result(pointer);
  result += '/';
  for (const char c : key) {
    if (c == '~') {
      result += "~0";
    } else if (c == '/') {
      result += "~1";
    } else {
      result += c;
    }
  }
  return result;
}

}  // namespace coordreq
