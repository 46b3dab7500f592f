#pragma once

#include <cstdint>
#include <string>

#include "model/uniform_grid.hpp"

namespace coordreq {

/// A cell by its centre: "x1 = 0.1, x2 = 0".
[[nodiscard]] std::string place_of(const UniformGrid& grid, std::int64_t cell);

}  // namespace coordreq
