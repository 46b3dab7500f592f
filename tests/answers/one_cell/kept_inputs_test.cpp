#include "answers/one_cell/kept_inputs.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

using Numbers = KeptInputs::Numbers;

TEST(KeptInputs, KnowsWhatItKeeps) {
  KeptInputs kept;
  EXPECT_EQ(kept.find(3), nullptr);
  EXPECT_EQ(kept.keep(3, {1, 4}), (Numbers{1, 4}));
  EXPECT_EQ(kept.keep(5, {}), Numbers{});
  ASSERT_NE(kept.find(3), nullptr);
  EXPECT_EQ(*kept.find(3), (Numbers{1, 4}));
  ASSERT_NE(kept.find(5), nullptr);
  EXPECT_EQ(kept.find(4), nullptr);
}

TEST(KeptInputs, ForgetsAllBeforeItTakesMoreMemory) {
  const Numbers quarter(KeptInputs::kMostBytes / sizeof(std::int64_t) / 4, 7);
  KeptInputs kept;
  for (std::int64_t cell = 0; cell < 3; ++cell) kept.keep(cell, quarter);
  EXPECT_NE(kept.find(0), nullptr);
  EXPECT_EQ(kept.keep(3, quarter), quarter);
  EXPECT_EQ(kept.find(0), nullptr);
  EXPECT_NE(kept.find(3), nullptr);
}

}  // namespace
}  // namespace coordreq
