#include "app/named_values.hpp"

#include <fmt/format.h>

#include <charconv>

#include "base/error.hpp"
#include "cell/state_text.hpp"

namespace coordreq {

NamedValues parse_named_values(const std::string& text, const std::string& option) {
  NamedValues values;
  for (const std::string_view part : split_at_commas(text)) {
    const std::size_t sign = part.find('=');
    if (sign == std::string_view::npos) {
      throw UsageError(fmt::format("expected NAME=VALUE, found '{}'", trimmed(part)), option);
    }
    const std::string name(trimmed(part.substr(0, sign)));
    for (const auto& other : values) {
      if (other.first == name) throw UsageError(fmt::format("'{}' is given twice", name), option);
    }
    values.emplace_back(name, parse_value(part.substr(sign + 1), option + ", " + name));
  }
  return values;
}

std::uint64_t parse_whole_number(const std::string& text, std::uint64_t lowest, std::uint64_t highest,
                                 const std::string& option) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < lowest || value > highest) {
    throw UsageError(fmt::format("expected a whole number from {} to {}, found '{}'", lowest, highest, text),
                     option);
  }
  return value;
}

}  // namespace coordreq
