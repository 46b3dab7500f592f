#pragma once

#include <string>
#include <vector>

#include "export/cell_table.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// Reads "v2=2.8" (the cells in which v2 has this value) and "p2:min" or "p2:max", one or several with commas
/// between. @throws UsageError naming what is unknown, repeated or outside of the domain
[[nodiscard]] TableSelection parse_selection(const std::vector<std::string>& slices,
                                             const std::vector<std::string>& projections,
                                             const UniformGrid& grid);

}  // namespace coordreq
