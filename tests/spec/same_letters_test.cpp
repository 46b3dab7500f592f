#include "spec/wording.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

TEST(SameLetters, CapitalsAloneDiffer) {
  EXPECT_EQ(same_letters("V1", {"u1", "v1"}), ", did you mean 'v1'?");
  EXPECT_EQ(same_letters("vMax", {"VMAX"}), ", did you mean 'VMAX'?");
  EXPECT_EQ(same_letters("v2", {"v1"}), "");
  EXPECT_EQ(same_letters("v", {"v1"}), "");
  EXPECT_EQ(same_letters("", {"v1"}), "");
}

TEST(SameLetters, TheyComeBeforeOtherSlips) {
  EXPECT_EQ(suggestion("STEP", {"stop", "step"}), ", did you mean 'step'?");
}

}  // namespace
}  // namespace coordreq
