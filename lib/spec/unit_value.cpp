#include "spec/units.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string>

#include "base/requires.hpp"

namespace coordreq {
namespace {

struct NamedUnit {
  std::string_view name;
  UnitValue value;
};

constexpr std::array<int, 3> kNumber{}, kLength{1, 0, 0}, kDuration{0, 1, 0}, kMass{0, 0, 1},
    kSpeed{1, -1, 0};
constexpr double kPi = std::numbers::pi;

constexpr std::array kUnits = {NamedUnit{"m", {1, kLength}},
                               NamedUnit{"mm", {1e-3, kLength}},
                               NamedUnit{"cm", {1e-2, kLength}},
                               NamedUnit{"dm", {1e-1, kLength}},
                               NamedUnit{"km", {1e3, kLength}},
                               NamedUnit{"ft", {0.3048, kLength}},
                               NamedUnit{"nmi", {1852, kLength}},
                               NamedUnit{"s", {1, kDuration}},
                               NamedUnit{"ms", {1e-3, kDuration}},
                               NamedUnit{"us", {1e-6, kDuration}},
                               NamedUnit{"ns", {1e-9, kDuration}},
                               NamedUnit{"min", {60, kDuration}},
                               NamedUnit{"h", {3600, kDuration}},
                               NamedUnit{"d", {86400, kDuration}},
                               NamedUnit{"kg", {1, kMass}},
                               NamedUnit{"g", {1e-3, kMass}},
                               NamedUnit{"t", {1e3, kMass}},
                               NamedUnit{"N", {1, {1, -2, 1}}},
                               NamedUnit{"Hz", {1, {0, -1, 0}}},
                               NamedUnit{"kmh", {1 / 3.6, kSpeed}},
                               NamedUnit{"kph", {1 / 3.6, kSpeed}},
                               NamedUnit{"mph", {0.44704, kSpeed}},
                               NamedUnit{"rad", {1, kNumber}},
                               NamedUnit{"mrad", {1e-3, kNumber}},
                               NamedUnit{"deg", {kPi / 180, kNumber}},
                               NamedUnit{"degree", {kPi / 180, kNumber}},
                               NamedUnit{"degrees", {kPi / 180, kNumber}}};

/// Reads one after the other; stops for good at what it does not know.
class UnitReader {
 public:
  explicit UnitReader(std::string_view text) : rest_(text) {}

  std::optional<UnitValue> read() {
    UnitValue result;
    bool divides = false;
    for (;;) {
      skip_blanks();
      const std::optional<UnitValue> next = factor();
      if (!next) return std::nullopt;
      result = divides ? result / *next : result * *next;
      skip_blanks();
      if (rest_.empty()) return result;
      divides = rest_.front() == '/';
      if (divides || rest_.front() == '*' || rest_.front() == '.') rest_.remove_prefix(1);
    }
  }

 private:
  void skip_blanks() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
  }

  std::optional<UnitValue> factor() {
    if (!rest_.empty() && rest_.front() == '1') {
      rest_.remove_prefix(1);
      return UnitValue{};
    }
    const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
    const auto end = std::find_if_not(rest_.begin(), rest_.end(), is_letter);
    const std::string_view name = rest_.substr(0, static_cast<std::size_t>(end - rest_.begin()));
    const auto* const found =
        std::find_if(kUnits.begin(), kUnits.end(), [&](const NamedUnit& unit) { return unit.name == name; });
    if (found == kUnits.end()) return std::nullopt;
    rest_.remove_prefix(name.size());
    return power(found->value, exponent());
  }

  /// "^2", "^-1", "2", "-1"; none: 1.
  int exponent() {
    std::size_t position = 0;
    const auto at = [&](std::size_t i) { return i < rest_.size() ? rest_[i] : ' '; };
    if (at(position) == '^') ++position;
    const bool is_negative = at(position) == '-';
    if (is_negative) ++position;
    if (at(position) < '1' || at(position) > '9') return 1;
    const int digit = at(position) - '0';
    rest_.remove_prefix(position + 1);
    return is_negative ? -digit : digit;
  }

  std::string_view rest_;
};

UnitValue combined(const UnitValue& a, const UnitValue& b, int sign) {
  UnitValue result{sign > 0 ? a.scale * b.scale : a.scale / b.scale, a.powers};
  for (std::size_t i = 0; i < result.powers.size(); ++i) result.powers[i] += sign * b.powers[i];
  return result;
}

}  // namespace

UnitValue operator*(const UnitValue& a, const UnitValue& b) {
  return combined(a, b, 1);
}

UnitValue operator/(const UnitValue& a, const UnitValue& b) {
  return combined(a, b, -1);
}

bool is_same(const UnitValue& a, const UnitValue& b) {
  constexpr double kRounding = 1e-10;
  return a.powers == b.powers && std::fabs(a.scale / b.scale - 1) < kRounding;
}

UnitValue power(const UnitValue& unit, int exponent) {
  REQUIRES(-9 <= exponent && exponent <= 9);
  UnitValue result{std::pow(unit.scale, exponent), unit.powers};
  for (int& power : result.powers) power *= exponent;
  return result;
}

std::optional<UnitValue> unit_value(std::string_view text) {
  constexpr std::size_t kLongest = 64;  // of what means something
  if (text.empty() || text.size() > kLongest) return std::nullopt;
  return UnitReader(udunits_spelling(text)).read();
}

}  // namespace coordreq
