#include "results/results_reader.hpp"

#include "answers/step_codes.hpp"

namespace coordreq {

std::int64_t first_largest(const UniformGrid& grid, const ReadCells& read) {
  std::int64_t cell = 0, best = -1;
  std::int32_t largest = -1;
  for_each_block(grid, read, [&](const CellBlock& /*block*/, const std::vector<std::int32_t>& values) {
    for (const std::int32_t value : values) {
      const bool infinite = value == kUnbounded;
      if (infinite ? best < 0 : value > largest) {
        best = cell;
        largest = infinite ? -1 : value;
      }
      ++cell;
    }
  });
  return best;
}

}  // namespace coordreq
