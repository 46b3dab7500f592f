#include "app/render.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace coordreq {
namespace {

TEST(ProbabilityText, HasThreeDigitsAndIsNeverLess) {
  EXPECT_EQ(probability_text(0.0), "0");
  EXPECT_EQ(probability_text(1.0), "1");
  EXPECT_EQ(probability_text(0.25), "0.25");
  EXPECT_EQ(probability_text(0.1), "0.1");
  EXPECT_EQ(probability_text(0.12301), "0.124");
  EXPECT_EQ(probability_text(0.99951), "1");
  EXPECT_EQ(probability_text(1.2301e-9), "1.24e-09");
  EXPECT_EQ(probability_text(9.991e-9), "1e-08");
  for (double p = 1e-40; p < 1; p *= 1.37) EXPECT_GE(std::stod(probability_text(p)), p) << p;
}

}  // namespace
}  // namespace coordreq
