#pragma once

#include "answers/ground.hpp"
#include "answers/requirements/escape_path.hpp"
#include "answers/requirements/requirement.hpp"

namespace coordreq {

/// A way out with what stands for its cells and actions, cells by the numbers of the spec's grid.
/// @param asked what its cells are judged by @param number_stride as in EscapeSets
[[nodiscard]] ResultPath result_of(const EscapePath& found, const Ground& ground,
                                   const CellRequirement& asked,
                                   const std::vector<std::int64_t>& number_stride);

}  // namespace coordreq
