#include "answers/requirements/requirement.hpp"

#include <gtest/gtest.h>

#include "answers/step_codes.hpp"

namespace coordreq {
namespace {

using Kind = RequirementKind;

TEST(Requirement, FailsBeyondItsBound) {
  for (const Kind kind : {Kind::min_delay, Kind::min_approach_delay}) {
    EXPECT_TRUE(fails(kind, 3, 2));
    EXPECT_FALSE(fails(kind, 3, 3));
    EXPECT_FALSE(fails(kind, 3, kUnbounded));
  }
  EXPECT_FALSE(fails(Kind::max_arrival, 3, 2));
  EXPECT_FALSE(fails(Kind::max_arrival, 3, 3));
  EXPECT_TRUE(fails(Kind::max_arrival, 3, 4));
  EXPECT_FALSE(fails(Kind::max_arrival, 0, 0));
  EXPECT_FALSE(fails(Kind::invariant, 0, kUnbounded));
}

TEST(Requirement, FailsOutsideWhateverItAsks) {
  for (const Kind kind : {Kind::min_delay, Kind::invariant, Kind::max_arrival, Kind::min_approach_delay}) {
    for (const std::int32_t value : {kOutsideSafe, kOutsideInvariant, kOutsideWinning})
      EXPECT_TRUE(fails(kind, 0, value));
  }
}

/// Outside S, outside K, outside W, then what is less than asked for, or later.
TEST(Requirement, WorseCellsRankLower) {
  const auto rank = [](std::int32_t value) { return rank_of(Kind::min_approach_delay, value); };
  EXPECT_LT(rank(kOutsideSafe), rank(kOutsideInvariant));
  EXPECT_LT(rank(kOutsideInvariant), rank(kOutsideWinning));
  EXPECT_LT(rank(kOutsideWinning), rank(0));
  EXPECT_LT(rank(0), rank(1));
  EXPECT_LT(rank_of(Kind::max_arrival, 5), rank_of(Kind::max_arrival, 4));
  EXPECT_LT(rank_of(Kind::max_arrival, kOutsideInvariant), rank_of(Kind::max_arrival, kUnbounded));
}

}  // namespace
}  // namespace coordreq
