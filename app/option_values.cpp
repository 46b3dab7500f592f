#include "app/option_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "app/text.hpp"
#include "base/error.hpp"
#include "cell/state_text.hpp"
#include "numeric/rational.hpp"
#include "spec/units.hpp"

namespace coordreq {

void fail_value(const std::string& expected, const std::string& found, const std::string& option) {
  throw UsageError(fmt::format("expected {}, found {}", expected, echoed(found)), option);
}

std::string range_text(const std::string& lowest, const std::string& highest) {
  const bool is_open = highest == std::to_string(INT64_MAX);
  return fmt::format("a whole number from {}{}", lowest, is_open ? "" : " to " + highest);
}

std::string as_typed(const std::string& text, const std::string& /*option*/) {
  return text;
}

std::string file_name(const std::string& text, const std::string& option) {
  if (text.empty() || text == "-") fail_value("the name of a file", text, option);
  return text;
}

double seconds(const std::string& text, const std::string& option) {
  constexpr double kMost = 1e9;
  if (const std::optional<Rational> time = time_in(text, "s");
      time && *time >= 0 && *time <= Rational(1'000'000'000))
    return nearest_double(*time);
  double seconds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  if (!is_whole || !(seconds >= 0 && seconds <= kMost))
    fail_value("a number of seconds from 0", text, option);
  return std::abs(seconds);  // of -0
}

std::uint64_t memory_size(const std::string& text, const std::string& option) {
  const auto fail = [&] { fail_value("a size such as 500M, 1.5GiB or a number of bytes", text, option); };
  const std::size_t digits = std::min(text.find_first_not_of("0123456789."), text.size());
  const std::optional<Rational> number = parse_decimal(std::string_view(text).substr(0, digits));
  std::string unit = text.substr(digits);
  for (char& c : unit) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  constexpr std::string_view kPrefixes = "KMGT";
  std::int64_t factor = 1;
  if (!unit.empty() && unit != "B") {
    const std::size_t power = kPrefixes.find(unit.front());
    const std::string rest = unit.substr(1);
    if (power == std::string_view::npos || !(rest.empty() || rest == "B" || rest == "IB")) fail();
    for (std::size_t i = 0; i <= power; ++i) factor *= 1024;
  }
  if (!number || *number * factor < 1) fail();
  return static_cast<std::uint64_t>(floor_to_int(*number * factor));
}

NamedValues named_values(const std::string& text, const std::string& option) {
  NamedValues values;
  for (const std::string_view assignment : split_at_commas(text)) {
    const std::size_t sign = assignment.find('=');
    if (sign == std::string_view::npos) fail_value("NAME=VALUE", std::string(trimmed(assignment)), option);
    const std::string name(trimmed(assignment.substr(0, sign)));
    for (const auto& other : values) {
      if (other.first == name) throw UsageError(echoed(name) + " is given twice", option);
    }
    values.emplace_back(name, parse_value(assignment.substr(sign + 1), option + ", " + name));
  }
  return values;
}

}  // namespace coordreq
