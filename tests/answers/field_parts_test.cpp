#include "answers/field_parts.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <nlohmann/json.hpp>

namespace coordreq {
namespace {

Field steps_field() {
  return {.path = "/time",
          .kind = FieldKind::steps,
          .types = {ElementType::int16, ElementType::int32},
          .axes = {"/x"},
          .least = -2,
          .attributes = described("a time") +
                        std::vector<FieldAttribute>{flags({{-2, "not_safe"}, {kLargestValue, "never"}})}};
}

TEST(FieldValue, IsItselfUnlessItMeansAWord) {
  const Field field = steps_field();
  EXPECT_EQ(value_json(field, 7), 7);
  EXPECT_EQ(status_of(field, 7), "steps");
  EXPECT_TRUE(value_json(field, -2).is_null());
  EXPECT_EQ(status_of(field, -2), "not_safe");
}

TEST(FieldValue, TheLargestIsReadAsThatOfThirtyTwoBits) {
  EXPECT_TRUE(value_json(steps_field(), INT32_MAX).is_null());
  EXPECT_EQ(status_of(steps_field(), INT32_MAX), "never");
  EXPECT_EQ(status_of(steps_field(), INT16_MAX), "steps");
}

TEST(FieldValue, WithoutFlagsIsANumber) {
  Field field = steps_field();
  field.attributes = described("a number");
  field.kind = FieldKind::choice;
  EXPECT_TRUE(flags_of(field).empty());
  EXPECT_EQ(status_of(field, -2), "number");
  EXPECT_EQ(value_json(field, -2), -2);
}

TEST(FieldValue, OfProbabilitiesAreTheirBitsWhichOrderLikeThem) {
  const Field field = {.path = "/risk", .kind = FieldKind::probability, .types = {ElementType::float32}};
  const auto bits = [](float p) { return std::bit_cast<std::int32_t>(p); };
  EXPECT_EQ(value_json(field, bits(0.25F)), 0.25);
  EXPECT_EQ(value_json(field, bits(0)), 0.0);
  EXPECT_EQ(status_of(field, bits(1)), "number");
  EXPECT_EQ(bits(0), 0);
  EXPECT_LT(bits(0), bits(1e-40F));
  EXPECT_LT(bits(1e-40F), bits(1e-7F));
  EXPECT_LT(bits(1e-7F), bits(1));
}

}  // namespace
}  // namespace coordreq
