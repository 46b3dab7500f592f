#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "numeric/rational.hpp"

namespace coordreq {

/// "500ms", "10 min", "1.5 h": a decimal and a unit of time, with or without a blank between, in another unit
/// of time, exactly: time_in("500ms", "s") is 1/2. Units are those that udunits_spelling() knows, words or
/// symbols.
/// @returns nothing if the text is no such time, or `unit` no unit of time
[[nodiscard]] std::optional<Rational> time_in(std::string_view text, std::string_view unit);

/// Whether it is a unit that time_in() knows.
[[nodiscard]] bool is_time_unit(std::string_view unit);

/// `unit` as the results file spells it: the words for units of time, also inside compounds, become their
/// UDUNITS symbols (sec, second, seconds -> s; minute, minutes -> min; hour, hours, hr -> h; likewise d, ms,
/// us and ns); everything else stays as written. An empty unit becomes "1", UDUNITS' name for a plain number.
///
/// Symbols rather than words because xarray turns every variable whose unit is the word "seconds" (or
/// minutes, hours, days, ...) into a time difference, and would do that to a grid of times.
[[nodiscard]] std::string udunits_spelling(std::string_view unit);

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
