#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "answers/field.hpp"

namespace coordreq {

/// Values over a box of cells in three dimensions, as plain data for tools that draw. Where fewer states are
/// shown, the other dimensions have one cell and an axis without a name.
struct ImageContent {
  std::string title;
  std::array<std::string, 3> axes;         ///< of x, y, z: "p1 [m]"
  std::string cut;                         ///< what is shown of the other states: "v2 = 2.8 m/s, p2: min"
  std::array<double, 3> origin{};          ///< the corner at the lower end of all axes
  std::array<double, 3> spacing{1, 1, 1};  ///< sides of a cell
  std::array<std::uint64_t, 3> cells{1, 1, 1};  ///< along each axis

  struct Array {
    std::string name;
    ResultArray values;  ///< cells[0] * cells[1] * cells[2] elements, x fastest
  };
  std::vector<Array> arrays;
};

}  // namespace coordreq
