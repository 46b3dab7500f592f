#include "spec/units.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace coordreq {
namespace {

/// Nanoseconds of a unit.
std::optional<Rational> length_of(std::string_view unit) {
  struct Length {
    std::string_view symbol;
    const char* nanoseconds;
  };
  static constexpr std::array kLengths = {Length{"ns", "1"},
                                          Length{"us", "1000"},
                                          Length{"ms", "1000000"},
                                          Length{"s", "1000000000"},
                                          Length{"min", "60000000000"},
                                          Length{"h", "3600000000000"},
                                          Length{"d", "86400000000000"}};
  if (unit.empty()) return std::nullopt;
  const std::string symbol = udunits_spelling(unit);
  const auto* const found =
      std::ranges::find_if(kLengths, [&](const Length& length) { return length.symbol == symbol; });
  if (found == kLengths.end()) return std::nullopt;
  return parse_decimal(found->nanoseconds);
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

}  // namespace

std::optional<Rational> time_in(std::string_view text, std::string_view unit) {
  text = without_blanks(text);
  const std::size_t end = text.find_last_of("0123456789.");
  if (end == std::string_view::npos) return std::nullopt;
  const std::optional<Rational> number = parse_decimal(text.substr(0, end + 1));
  const std::optional<Rational> unit_length = length_of(without_blanks(text.substr(end + 1)));
  const std::optional<Rational> other = length_of(unit);
  if (!number || !unit_length || !other) return std::nullopt;
  return Rational(*number * *unit_length / *other);
}

bool is_time_unit(std::string_view unit) {
  return length_of(unit).has_value();
}

}  // namespace coordreq
