#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <string>

#include "expression/expression_helpers.hpp"

namespace coordreq {
namespace {

int pick(int count) {
  return *rc::gen::inRange(0, count);
}

std::string random_condition(int depth);

std::string random_leaf() {
  if (pick(3) > 0) return std::string(kVariables[static_cast<std::size_t>(pick(3))]);
  return std::to_string(pick(8)) + (pick(2) == 0 ? "" : ".25");
}

std::string random_number(int depth) {
  if (depth == 0) return random_leaf();
  const auto next = [&] { return random_number(depth - 1); };
  switch (pick(14)) {
    case 0:
      return "(" + next() + " + " + next() + ")";
    case 1:
      return "(" + next() + " - " + next() + ")";
    case 2:
    case 3:
      return "(" + next() + " * " + next() + ")";
    case 4:
      return "(" + next() + " / " + next() + ")";
    case 5:
      return "(" + next() + ")^" + std::to_string(pick(7) - 3);
    case 6:
      return "-" + next();
    case 7:
      return "abs(" + next() + ")";
    case 8:
      return "min(" + next() + ", " + next() + ")";
    case 9:
      return "max(" + next() + ", " + next() + ")";
    case 10:
      return "floor(" + next() + ")";
    case 11:
      return "mod(" + next() + ", " + next() + ")";
    case 12:
      return "if(" + random_condition(depth - 1) + ", " + next() + ", " + next() + ")";
    default:
      return "sign(" + next() + ")";
  }
}

std::string random_condition(int depth) {
  constexpr std::array<const char*, 6> kComparisonTexts{" < ", " <= ", " > ", " >= ", " == ", " != "};
  const auto comparison = [&] { return kComparisonTexts[static_cast<std::size_t>(pick(6))]; };
  if (depth > 0 && pick(2) == 0) {
    switch (pick(3)) {
      case 0:
        return "(" + random_condition(depth - 1) + " and " + random_condition(depth - 1) + ")";
      case 1:
        return "(" + random_condition(depth - 1) + " or " + random_condition(depth - 1) + ")";
      default:
        return "(not " + random_condition(depth - 1) + ")";
    }
  }
  return "(" + random_number(depth) + comparison() + random_number(depth) + ")";
}

/// A box of three dimensions and a point in it.
struct Sample {
  std::array<RationalInterval, 3> box;
  std::array<RationalInterval, 3> point;
  std::array<Interval, 3> rounded_box;
};

Sample random_sample() {
  Sample sample;
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<Rational, 3> values;
    for (Rational& value : values) value = Rational(pick(13) - 6) / Rational(1 + pick(4));
    if (pick(3) == 0) values[1] = values[2] = values[0];
    std::sort(values.begin(), values.end());
    sample.box[i] = {values[0], values[2], true, true};
    sample.point[i] = exactly(values[1]);
    sample.rounded_box[i] = enclose(sample.box[i]);
  }
  return sample;
}

bool contains(const Interval& a, const Rational& q) {
  return (a.lower == -outward::kInfinity || exact(a.lower) <= q) &&
         (a.upper == outward::kInfinity || exact(a.upper) >= q);
}

TEST(RandomExpression, EnclosuresContainTheExactValueOfEveryPoint) {
  EXPECT_TRUE(rc::check([] {
    const std::string text = random_number(4);
    const Sample sample = random_sample();
    const Program program = link_xyz(text, ExpectedType::number);
    const RationalInterval value = Evaluator<RationalInterval>(program).number(sample.point);
    const RationalInterval range = Evaluator<RationalInterval>(program).number(sample.box);
    const Interval rounded = Evaluator<Interval>(program).number(sample.rounded_box);
    RC_LOG(text);
    RC_CLASSIFY(value.is_point(), "defined");
    if (!value.is_point()) {
      RC_ASSERT(!value.total && !range.total && !rounded.total);
      return;
    }
    RC_ASSERT(!range.bounded || (range.lower <= value.lower && value.lower <= range.upper));
    RC_ASSERT(contains(rounded, value.lower));
  }));
}

TEST(RandomExpression, DecidedConditionsHoldAtEveryPoint) {
  EXPECT_TRUE(rc::check([] {
    const std::string text = random_condition(3);
    const Sample sample = random_sample();
    const Program program = link_xyz(text, ExpectedType::condition);
    const Truth at_point = Evaluator<RationalInterval>(program).condition(sample.point);
    const Truth on_box = Evaluator<RationalInterval>(program).condition(sample.box);
    const Truth on_rounded_box = Evaluator<Interval>(program).condition(sample.rounded_box);
    RC_LOG(text);
    RC_CLASSIFY(on_box != Truth::undecided, "decided");
    RC_ASSERT(on_box == Truth::undecided || on_box == at_point);
    RC_ASSERT(on_rounded_box == Truth::undecided || on_rounded_box == at_point);
  }));
}

TEST(RandomExpression, MentionsOnlyItsVariables) {
  EXPECT_TRUE(rc::check([] {
    const std::string text = random_number(3);
    const std::vector<std::string> names = mentioned_names(text, "");
    for (const std::uint32_t slot : link_xyz(text).variables()) {
      RC_ASSERT(std::find(names.begin(), names.end(), kVariables[slot]) != names.end());
    }
  }));
}

}  // namespace
}  // namespace coordreq
