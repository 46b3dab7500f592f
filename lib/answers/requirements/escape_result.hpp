#pragma once

#include "answers/analysis_context.hpp"
#include "answers/requirements/escape_path.hpp"
#include "answers/requirements/requirement.hpp"

namespace coordreq {

/// The result for a way out: with states, delays and inputs, and cells by the numbers of the spec's grid.
/// @param asked the requirement by whose values cells are judged @param number_stride as in EscapeSets
[[nodiscard]] ResultPath result_of(const EscapePath& found, const AnalysisContext& context,
                                   const CellRequirement& asked,
                                   const std::vector<std::int64_t>& number_stride);

}  // namespace coordreq
