#pragma once

#include <fmt/format.h>

#include <string>

#include "grid/uniform_grid.hpp"

namespace coordreq {

/// "x1 = 0.5, x2 = -1": the centre of a cell, for messages.
[[nodiscard]] inline std::string cell_place(const UniformGrid& grid, std::int64_t cell) {
  std::string text;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    text += fmt::format("{}{} = {}", i == 0 ? "" : ", ", grid[i].name,
                        to_text(grid[i].point(grid.index(cell, i))));
  }
  return text;
}

}  // namespace coordreq
