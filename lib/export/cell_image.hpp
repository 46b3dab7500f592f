#pragma once

#include "export/cell_table.hpp"
#include "export/image_content.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// The columns of a table over cells as an image: the states that the selection leaves are its axes, in the
/// order of the spec. Each array is float64, coded as in the results file, with infinity for its maximum, so
/// that a colour scale over what is finite shows the steps.
///
/// Memory: 4 bytes for each cell that is left and each column.
/// @throws UsageError if more than three states are left
[[nodiscard]] ImageContent cell_image(const ResultsReader& results, const TableSelection& selection);
/// Memory of cell_image(), in bytes.
[[nodiscard]] double image_bytes(const ResultsReader& results, const TableSelection& selection);

}  // namespace coordreq
