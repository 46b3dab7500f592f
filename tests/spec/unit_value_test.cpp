#include "spec/units.hpp"

#include <gtest/gtest.h>

#include <string>

namespace coordreq {
namespace {

bool are_same(const char* a, const char* b) {
  const auto first = unit_value(a), second = unit_value(b);
  return first && second && is_same(*first, *second);
}

TEST(UnitValue, OneUnitHasManySpellings) {
  EXPECT_TRUE(are_same("m/s^2", "m s-2"));
  EXPECT_TRUE(are_same("m/s^2", "m/s/s"));
  EXPECT_TRUE(are_same("m/s^2", "m.s^-2"));
  EXPECT_TRUE(are_same("m / s", "m*1/s"));
  EXPECT_TRUE(are_same("m/second", "m/sec"));
  EXPECT_TRUE(are_same("1/s", "Hz"));
  EXPECT_TRUE(are_same("km/h", "kmh"));
  EXPECT_TRUE(are_same("kg m/s^2", "N"));
}

TEST(UnitValue, ScalesAreTold) {
  EXPECT_DOUBLE_EQ(unit_value("km/h")->scale, 1 / 3.6);
  EXPECT_DOUBLE_EQ(unit_value("cm^2")->scale, 1e-4);
  EXPECT_DOUBLE_EQ(unit_value("rad/min")->scale, 1.0 / 60);
  EXPECT_FALSE(are_same("m", "cm"));
  EXPECT_FALSE(are_same("ms", "s"));
  EXPECT_FALSE(are_same("deg", "rad"));
}

TEST(UnitValue, DimensionsAreTold) {
  EXPECT_FALSE(are_same("m/s", "m/s^2"));
  EXPECT_FALSE(are_same("m/s", "s/m"));
  EXPECT_FALSE(are_same("kg", "m"));
  EXPECT_FALSE(unit_value("deg")->has_dimension());
  EXPECT_TRUE(unit_value("m")->has_dimension());
  EXPECT_EQ(unit_value("N s")->powers, (std::array<int, 3>{1, -1, 1}));
}

TEST(UnitValue, WhatIsNotInTheTableIsNoUnit) {
  for (const char* text : {"", "furlong", "m/furlong", "M", "2 m", "m^", "parsec s-1", "%"})
    EXPECT_FALSE(unit_value(text)) << text;
  EXPECT_FALSE(unit_value(std::string(65, 'm')));
}

TEST(UnitValue, PowersMultiplyPowers) {
  const UnitValue speed = *unit_value("km/h");
  EXPECT_TRUE(is_same(power(speed, 2), speed * speed));
  EXPECT_TRUE(is_same(power(speed, -1), UnitValue{} / speed));
  EXPECT_TRUE(is_same(power(speed, 0), UnitValue{}));
}

}  // namespace
}  // namespace coordreq
