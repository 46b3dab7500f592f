#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "export/report_cells.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// A number a cell: steps, or a place in a list; -3 to -1 are flags, ResultsReader::kNever is infinity.
using ReadCells = std::function<std::vector<std::int32_t>(const CellBlock&)>;

/// The values of some cells, packed; see report_data().
struct PackedMap {
  int bytes = 1;     ///< of a number
  std::string data;  ///< base64
};

/// One map for each of some sets of cells.
struct PackedMaps {
  std::vector<PackedMap> sets;
  std::int32_t largest = 0;         ///< finite value, over all cells of the file; 0 if none is larger
  std::vector<std::int32_t> flags;  ///< and what else there is, ascending
};

/// In the order of the sets; the file is read once.
[[nodiscard]] PackedMaps pack_map(const UniformGrid& grid, const ReadCells& read,
                                  const std::vector<ReportCells>& sets);

/// The first cell with the largest finite value of at least 0; if there is none the first with an infinite
/// one; else -1.
[[nodiscard]] std::int64_t first_largest(const UniformGrid& grid, const ReadCells& read);

}  // namespace coordreq
