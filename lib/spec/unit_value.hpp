#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace coordreq {

/// The value of a unit: scale * m^a * s^b * kg^c. Angles have no dimension: rad is 1, deg is pi / 180.
struct UnitValue {
  double scale = 1;
  std::array<int, 3> powers{};  ///< of m, s and kg

  [[nodiscard]] bool has_dimension() const { return powers != std::array<int, 3>{}; }
};

[[nodiscard]] UnitValue operator*(const UnitValue& a, const UnitValue& b);
[[nodiscard]] UnitValue operator/(const UnitValue& a, const UnitValue& b);
/// To some ten digits.
[[nodiscard]] bool is_same(const UnitValue& a, const UnitValue& b);
/// @pre -9 <= exponent <= 9
[[nodiscard]] UnitValue power(const UnitValue& unit, int exponent);

/// "m", "km/h", "m/s^2", "m s-2", "rad/min", "1/s": products and quotients of whole powers of the units of a
/// small table, and the words that udunits_spelling() knows. Nothing for all others, and for an empty text.
[[nodiscard]] std::optional<UnitValue> unit_value(std::string_view text);

}  // namespace coordreq
