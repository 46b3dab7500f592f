#pragma once

#include <string>

#include "base/json.hpp"

namespace coordreq {

/// The summary of an analysis with `nearest` in each requirement of a delay that fails in a cell: the state
/// of which the fewest steps of its grid, the others as in the worst cell, lead to values from which on, or
/// up to which, all cells have the delay asked for: `state`, `best` ("large" or "small") and `value`; null if
/// there is none.
/// @param results the file of this analysis
[[nodiscard]] Json with_nearest_regions(const Json& summary, const std::string& results);

}  // namespace coordreq
