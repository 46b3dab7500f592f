#pragma once

#include <string>
#include <string_view>

namespace coordreq {

/// `unit` as the results file spells it: the words for units of time, also inside compounds, become their
/// UDUNITS symbols (sec, second, seconds -> s; minute, minutes -> min; hour, hours, hr -> h; likewise d, ms,
/// us and ns); everything else stays as written. An empty unit becomes "1", UDUNITS' name for a plain number.
///
/// Symbols rather than words because xarray turns every variable whose unit is the word "seconds" (or
/// minutes, hours, days, ...) into a time difference, and would do that to a grid of times.
[[nodiscard]] std::string udunits_spelling(std::string_view unit);

}  // namespace coordreq
