#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "export/report_cells.hpp"
#include "results/first_largest.hpp"

namespace coordreq {

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

}  // namespace coordreq
