#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "model/uniform_grid.hpp"

namespace coordreq {

/// Cells that a page holds: all whose grid index in each dimension is one of `indices`.
struct ReportCells {
  std::optional<std::pair<std::size_t, std::size_t>>
      shows;                                       ///< the two dimensions of a picture; none: any two
  std::vector<std::vector<std::int64_t>> indices;  ///< of each dimension, ascending
  [[nodiscard]] std::int64_t count() const;
};

/// Which cells of a grid to show if there is room for `most` of them: all if they fit, else for every two
/// dimensions a separate set. In such a set the two have all their indices as far as there is room, and
/// each other dimension some of them, evenly spread with both ends (those of a periodic one are the same).
///
/// @param pins cells that should be among them, as grid indices: each other dimension takes theirs, the first
///   pins first, instead of the nearest ones. Example: 31 points, room for 3: 0 15 30, with a pin at 7: 7
///   15 30.
/// @pre most >= 1
[[nodiscard]] std::vector<ReportCells> choose_cells(const UniformGrid& grid, std::int64_t most,
                                                    const std::vector<std::vector<std::int64_t>>& pins);

}  // namespace coordreq
