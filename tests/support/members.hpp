#pragma once

#include <cstdint>
#include <vector>

#include "engine/cell_set.hpp"

namespace coordreq {

/// A set as the plain engine has them.
[[nodiscard]] inline std::vector<bool> members(const CellSet& set) {
  std::vector<bool> result;
  for (std::int64_t x = 0; x < set.cells(); ++x) result.push_back(set.test(x));
  return result;
}

}  // namespace coordreq
