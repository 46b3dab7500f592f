#pragma once

#include <cstdint>
#include <string>

#include "answers/checking/post_table.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// A cell by its centre: "x1 = 0.1, x2 = 0".
[[nodiscard]] std::string location_of(const UniformGrid& grid, std::int64_t cell);

/// The states and inputs that an entry of a table belongs to: "x1 = 0.1, u = 1".
[[nodiscard]] std::string entry_text(const UniformGrid& grid, const InputSpace& inputs,
                                     const PostTable& table, std::int64_t entry);

/// A range of cells by the centres of the first and the last: "0.5 to 0.7".
[[nodiscard]] std::string range_text(const GridDimension& dimension, IndexRange range);

}  // namespace coordreq
