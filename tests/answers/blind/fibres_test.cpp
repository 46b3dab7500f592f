#include "answers/blind/fibres.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

GridDimension of_count(const char* name, std::int64_t count) {
  return {.name = name, .first = 0, .step = 1, .count = count};
}

/// Gaps of rows along several dimensions are no cells, and belong to no fibre.
TEST(Fibres, CellsOfRowsWithGapsAreInTheFibreOfWhatIsSeen) {
  const UniformGrid joined = UniformGrid({of_count("a", 2), of_count("b", 3), of_count("c", 5)}).in_rows({4});
  const Fibres fibres(joined, {0, 2});
  EXPECT_EQ(fibres.count(), 10);
  for (RowPosition position(joined, 0); position.row < joined.rows(); position.advance(joined)) {
    for (std::int64_t b = 0; b < 3; ++b) {
      for (std::int64_t c = 0; c < 5; ++c) {
        const std::int64_t lane = b * joined.stride(1) + c * joined.stride(2);
        EXPECT_EQ(fibres.base(position) + fibres.of_lane(lane), position.row * 5 + c);
      }
    }
  }
}

}  // namespace
}  // namespace coordreq
