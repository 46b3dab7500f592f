#pragma once

#include <optional>
#include <string_view>

#include "numeric/rational.hpp"

namespace coordreq {

/// "500ms", "10 min", "1.5 h": a decimal and a unit of time, with or without a blank between, in another unit
/// of time, exactly: time_in("500ms", "s") is 1/2. Units are those of unit_text.hpp, words or symbols.
/// @returns nothing if the text is no such time, or `unit` no unit of time
[[nodiscard]] std::optional<Rational> time_in(std::string_view text, std::string_view unit);

/// Whether it is a unit that time_in() knows.
[[nodiscard]] bool is_time_unit(std::string_view unit);

}  // namespace coordreq
