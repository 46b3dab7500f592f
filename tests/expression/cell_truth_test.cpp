#include "expression/cell_truth.hpp"

#include <gtest/gtest.h>

#include "support/condition_helpers.hpp"

namespace coordreq {
namespace {

/// One variable whose index 0 is a cell that a seam cuts: [0, 1] and [9, 10].
Truth at_the_seam(const char* text) {
  const auto ranges = [](std::int64_t) {
    return ConditionAxis::Ranges{{.lower = 0, .upper = 1}, {.lower = 9, .upper = 10}};
  };
  CellTruth truth(test::condition(text), {{.count = 1, .ranges = ranges}});
  const std::int64_t index = 0;
  return truth.at({&index, 1});
}

TEST(CellTruth, HoldsWhereAllPiecesOfACellSayTheSame) {
  EXPECT_EQ(at_the_seam("x <= 10"), Truth::yes);
  EXPECT_EQ(at_the_seam("x > 10"), Truth::no);
  EXPECT_EQ(at_the_seam("x <= 2"), Truth::undecided);
  EXPECT_EQ(at_the_seam("x >= 5"), Truth::undecided);
  // Comparisons are joined one by one, though each point satisfies one of the two.
  EXPECT_EQ(at_the_seam("x <= 2 or x >= 5"), Truth::undecided);
}

}  // namespace
}  // namespace coordreq
