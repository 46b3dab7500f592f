#include "results/scots_text.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <system_error>

#include "base/error.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

}  // namespace

ScotsText::ScotsText(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  if (!file_) throw IoError("cannot read the controller: " + std::generic_category().message(errno), path);
}

std::string ScotsText::place(std::int64_t line) const {
  return fmt::format("{}, line {}", path_, line);
}

std::string_view ScotsText::next(std::string_view wanted) {
  while (std::getline(file_, line_)) {
    ++line_number_;
    const std::string_view text = without_blanks(line_);
    if (!text.empty()) return text;
  }
  if (file_.bad()) throw IoError("cannot read the controller", path_);
  throw ControllerError(fmt::format("the file ends, expected {}", wanted), place());
}

void ScotsText::expect(std::string_view expected) {
  const std::string_view found = next(expected);
  if (found != expected) {
    throw ControllerError(fmt::format("found {}, expected {}", quote_text(found), quote_text(expected)),
                          place());
  }
}

std::int64_t ScotsText::member(std::string_view name) {
  expect(fmt::format("#MEMBER:{}", name));
  const std::vector<std::int64_t> value = naturals(next("a number"));
  if (value.size() != 1)
    throw ControllerError(fmt::format("expected one number, found {}", value.size()), place());
  return value.front();
}

std::vector<std::int64_t> ScotsText::begin() {
  constexpr std::string_view kBegin = "#BEGIN:";
  const std::string_view text = next("'#BEGIN:'");
  if (text.substr(0, kBegin.size()) != kBegin)
    throw ControllerError(fmt::format("found {}, expected '#BEGIN:'", quote_text(text)), place());
  return naturals(text.substr(kBegin.size()));
}

std::vector<ScotsText::Entry> ScotsText::vector(std::string_view name, std::size_t count) {
  expect(fmt::format("#VECTOR:{}", name));
  const std::vector<std::int64_t> size = begin();
  if (size.size() != 1 || size.front() != static_cast<std::int64_t>(count))
    throw ControllerError(fmt::format("found {} of {}, expected {}", fmt::join(size, " "), name, count),
                          place());
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view text = next("a number");
    Entry entry{.line = line_number_};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), entry.value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(entry.value))
      throw ControllerError(fmt::format("found {}, expected a number", quote_text(text)), place());
    entries.push_back(entry);
  }
  expect("#END");
  return entries;
}

std::vector<std::int64_t> ScotsText::naturals(std::string_view text) const {
  std::vector<std::int64_t> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    if (kBlanks.find(*at) != std::string_view::npos) {
      ++at;
      continue;
    }
    std::int64_t number = 0;
    const auto [rest, error] = std::from_chars(at, end, number);
    const bool is_word = rest == end || kBlanks.find(*rest) != std::string_view::npos;
    if (error != std::errc() || !is_word || number < 0)
      throw ControllerError(fmt::format("found {}, expected natural numbers", quote_text(text)), place());
    numbers.push_back(number);
    at = rest;
  }
  return numbers;
}

}  // namespace coordreq
