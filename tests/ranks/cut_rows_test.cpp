#include "ranks/cut_rows.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <numeric>

namespace coordreq {
namespace {

using RowNumbers = std::vector<std::int64_t>;

TEST(CutRows, SharesAreEqualWhereWeightsAre) {
  EXPECT_EQ(cut_rows(RowNumbers{1, 1, 1, 1}, 10, 40, 2), (RowNumbers{0, 20, 40}));
  EXPECT_EQ(cut_rows(RowNumbers{5, 1, 1, 1, 1, 1}, 1, 6, 2), (RowNumbers{0, 1, 6}));
}

/// Half of the rows weigh 4.5: 6 is nearer to it than 2.
TEST(CutRows, EndWhereTheSumIsNearest) {
  EXPECT_EQ(cut_rows(RowNumbers{2, 4, 3}, 1, 3, 2), (RowNumbers{0, 2, 3}));
  EXPECT_EQ(cut_rows(RowNumbers{3, 4, 2}, 1, 3, 2), (RowNumbers{0, 1, 3}));
}

TEST(CutRows, TheLastBlockMayBeShort) {
  EXPECT_EQ(cut_rows(RowNumbers{0, 1}, 2, 3, 3), (RowNumbers{0, 2, 3, 3}));
}

TEST(CutRows, WithoutWeightBlocksCount) {
  EXPECT_EQ(cut_rows(RowNumbers{0, 0, 0, 0}, 2, 7, 4), (RowNumbers{0, 2, 4, 6, 7}));
}

TEST(CutRows, ThereMayBeFewerRowsThanParts) {
  const RowNumbers bounds = cut_rows(RowNumbers{1, 1}, 1, 2, 5);
  EXPECT_EQ(bounds.size(), 6U);
  EXPECT_EQ(bounds.front(), 0);
  EXPECT_EQ(bounds.back(), 2);
  EXPECT_TRUE(std::is_sorted(bounds.begin(), bounds.end()));
}

TEST(CutRows, SharesDifferByABlockAtMost) {
  EXPECT_TRUE(rc::check("no share is further from the mean than the heaviest block", [] {
    const auto weights =
        *rc::gen::nonEmpty(rc::gen::container<RowNumbers>(rc::gen::inRange<std::int64_t>(0, 9)));
    const int parts = *rc::gen::inRange(1, 9);
    const auto rows = static_cast<std::int64_t>(weights.size());
    const RowNumbers bounds = cut_rows(weights, 1, rows, parts);
    RC_ASSERT(static_cast<int>(bounds.size()) == parts + 1);
    RC_ASSERT(std::is_sorted(bounds.begin(), bounds.end()));
    const std::int64_t total = std::accumulate(weights.begin(), weights.end(), std::int64_t{0});
    if (total == 0) return;
    const std::int64_t heaviest = *std::max_element(weights.begin(), weights.end());
    for (std::size_t part = 0; part + 1 < bounds.size(); ++part) {
      const std::int64_t own = std::accumulate(weights.begin() + bounds[part],
                                               weights.begin() + bounds[part + 1], std::int64_t{0});
      RC_ASSERT(std::abs(own * parts - total) <= heaviest * parts);
    }
  }));
}

}  // namespace
}  // namespace coordreq
