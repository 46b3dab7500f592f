#include "verify/cell_place.hpp"

#include <fmt/format.h>

namespace coordreq {

std::string place_of(const UniformGrid& grid, std::int64_t cell) {
  std::string text;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    text += fmt::format("{}{} = {}", i == 0 ? "" : ", ", grid[i].name,
                        to_text(grid[i].point(grid.index(cell, i))));
  }
  return text;
}

}  // namespace coordreq
