#include "spec/units.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace coordreq {
namespace {

struct Spelling {
  std::string_view name;
  std::string_view symbol;
};

constexpr std::array kTimeUnits = {
    Spelling{"sec", "s"},          Spelling{"second", "s"},        Spelling{"seconds", "s"},
    Spelling{"minute", "min"},     Spelling{"minutes", "min"},     Spelling{"hr", "h"},
    Spelling{"hour", "h"},         Spelling{"hours", "h"},         Spelling{"day", "d"},
    Spelling{"days", "d"},         Spelling{"millisecond", "ms"},  Spelling{"milliseconds", "ms"},
    Spelling{"microsecond", "us"}, Spelling{"microseconds", "us"}, Spelling{"nanosecond", "ns"},
    Spelling{"nanoseconds", "ns"}};

/// Bytes of non-ASCII letters count too, so that a word is never cut inside one.
bool belongs_to_name(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || byte == '_' || std::isalpha(byte) != 0;
}

std::string_view spelling_of(std::string_view name) {
  const auto* found = std::find_if(kTimeUnits.begin(), kTimeUnits.end(),
                                   [&](const Spelling& entry) { return entry.name == name; });
  return found == kTimeUnits.end() ? name : found->symbol;
}

}  // namespace

std::string udunits_spelling(std::string_view unit) {
  if (unit.empty()) return "1";
  std::string result;
  while (!unit.empty()) {
    const auto name_end = std::find_if_not(unit.begin(), unit.end(), belongs_to_name);
    const auto length = std::max<std::size_t>(1, static_cast<std::size_t>(name_end - unit.begin()));
    result += spelling_of(unit.substr(0, length));
    unit.remove_prefix(length);
  }
  return result;
}

}  // namespace coordreq
