#include "reach/box_division.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coordreq {
namespace {

/// x -> x^2 + w with |w| <= 0.3 times the width, defined where the subbox is narrower than `defined`.
class Parabola {
 public:
  explicit Parabola(double defined = outward::kInfinity) : defined_(defined) {}

  const FlowEnclosure& operator()(std::span<const Interval> box) {
    ++calls;
    const Interval& x = box.front();
    const double slack = 0.3 * (x.upper - x.lower);
    const bool ok = x.upper - x.lower < defined_;
    found_ = {.status = ok ? FlowEnclosure::Status::ok : FlowEnclosure::Status::blows_up};
    found_.end = {sqr(x) + Interval{-slack, slack}};
    const double middle = 0.5 * (x.lower + x.upper);
    if (ok) found_.reached = {Interval(middle * middle)};
    return found_;
  }
  int calls = 0;

 private:
  double defined_;
  FlowEnclosure found_;
};

Interval united(const BoxDivision& division) {
  Interval all = division.subboxes().front().found.end.front();
  for (const BoxDivision::Subbox& subbox : division.subboxes()) all = hull(all, subbox.found.end.front());
  return all;
}

struct Divided {
  bool found = false;
  int calls = 0;
  Interval range;
};
Divided divide(const EndCells& target, std::int64_t effort, double defined = outward::kInfinity) {
  BoxDivision division({target}, {1.0}, effort);
  Parabola f(defined);
  const std::vector<Interval> box{Interval{-1.0, 2.0}};
  division.begin({});
  division.add(box, f(box));
  const bool found =
      division.refine([&](std::span<const Interval> subbox) -> const FlowEnclosure& { return f(subbox); });
  return {found, f.calls, united(division)};
}

TEST(BoxDivision, EndsWhereCellsAreThoseOfWhatIsReached) {
  const Divided fine = divide({.step = 0.25}, 1000);
  EXPECT_TRUE(fine.found);
  EXPECT_LE(fine.range.upper, 4.0 + 0.125);
  EXPECT_GE(fine.range.lower, -0.125);
  EXPECT_LT(fine.calls, 100);
  const Divided coarse = divide({.step = 10.0}, 1000);
  EXPECT_EQ(coarse.calls, 1);
}

TEST(BoxDivision, NeverEnclosesMoreSubboxesThanTheEffort) {
  for (const std::int64_t effort : {1, 2, 3, 7, 20}) {
    const Divided some = divide({.step = 1e-4, .placed = false}, effort);
    EXPECT_TRUE(some.found);
    EXPECT_LE(some.calls, effort);
    EXPECT_GE(some.calls, effort - 1);
    EXPECT_LE(some.range.lower, 0.0);
    EXPECT_GE(some.range.upper, 4.0);
  }
}

TEST(BoxDivision, DearSubboxesTakeThePlaceOfOthers) {
  constexpr std::int64_t kEffort = 100;
  int usual = 0;
  for (const std::int64_t steps : {0, 1600, 16000}) {
    BoxDivision division({{.step = 1e-4, .placed = false}}, {1.0}, kEffort);
    Parabola f;
    const auto enclose = [&](std::span<const Interval> subbox) -> const FlowEnclosure& {
      division.charge(steps);
      return f(subbox);
    };
    const std::vector<Interval> box{Interval{-1.0, 2.0}};
    division.begin({});
    division.add(box, enclose(box));
    EXPECT_TRUE(division.refine(enclose));
    EXPECT_FALSE(division.is_lost());
    if (steps == 0) usual = f.calls;
    EXPECT_TRUE(steps == 16000 ? f.calls < usual / 5 : f.calls == usual) << steps << " steps: " << f.calls;
  }
}

TEST(BoxDivision, IsLostWithoutEffortForWhatHasNoEnclosure) {
  BoxDivision division({{.step = 10.0}}, {1.0}, 2);
  Parabola nowhere(0.0);
  const std::vector<Interval> box{Interval{-1.0, 2.0}};
  division.begin({});
  division.add(box, nowhere(box));
  EXPECT_TRUE(division.is_lost());
}

TEST(BoxDivision, SubboxesWithoutEnclosuresAreHalvedFirst) {
  EXPECT_TRUE(divide({.step = 10.0}, 1000, 0.5).found);
  EXPECT_FALSE(divide({.step = 10.0}, 10, 0.5).found);  // six subboxes are needed, and those on the way
  const Divided never = divide({.step = 10.0}, 100000, 0.0);
  EXPECT_FALSE(never.found);
  EXPECT_LT(never.calls, 100);  // the smallest of one place is tried, not all of them
}

TEST(BoxDivision, SubboxesThatWouldBeFarTooManyAreGivenUp) {
  const double small = 3.0 / 1024;  // 2,048 subboxes, and those on the way
  const Divided many = divide({.step = 10.0}, 200, small);
  EXPECT_FALSE(many.found);
  EXPECT_LT(many.calls, 40);
  EXPECT_TRUE(divide({.step = 10.0}, 10000, small).found);
}

TEST(BoxDivision, OnePlaceMayBeHardWhereAllOthersAreNot) {
  BoxDivision division({{.step = 10.0}}, {1.0}, 100);
  const std::vector<Interval> box{Interval{0.0, 1.0}};
  FlowEnclosure found;
  int calls = 0;
  const auto enclose = [&](std::span<const Interval> subbox) -> const FlowEnclosure& {
    ++calls;
    const bool ok = subbox.front().lower > 0.0 || subbox.front().upper < 1e-9;
    found = {.status = ok ? FlowEnclosure::Status::ok : FlowEnclosure::Status::blows_up};
    found.end = {subbox.front()};
    return found;
  };
  division.begin({});
  division.add(box, enclose(box));
  EXPECT_TRUE(division.refine(enclose));
  EXPECT_GT(calls, 50);  // past the first look
  EXPECT_EQ(united(division).lower, 0.0);
  EXPECT_EQ(united(division).upper, 1.0);
}

TEST(BoxDivision, WhatDoesNotGetBetterIsGivenUp) {
  BoxDivision division({{.step = 0.01, .placed = false}}, {1.0}, 100000);
  FlowEnclosure same{.status = FlowEnclosure::Status::ok};
  same.end = {Interval{0.0, 1.0}};
  same.reached = {Interval{0.4, 0.6}};
  int calls = 0;
  division.begin({});
  division.add({Interval{0.0, 1.0}}, same);
  EXPECT_TRUE(division.refine([&](std::span<const Interval>) -> const FlowEnclosure& {
    ++calls;
    return same;
  }));
  EXPECT_LT(calls, 10);
}

TEST(EndCells, CountCellsBeyondThoseOfAnother) {
  const EndCells cells{.first = 0.0, .step = 1.0};
  EXPECT_EQ(cells.more_cells({-0.4, 0.4}, {0.0, 0.0}), 0.0);
  EXPECT_EQ(cells.more_cells({-0.6, 2.4}, {0.0, 0.0}), 3.0);
  const EndCells measured{.first = 0.0, .step = 1.0, .reach = 0.2};
  EXPECT_EQ(measured.more_cells({-0.4, 0.4}, {0.0, 0.0}), 2.0);
  const EndCells somewhere{.step = 0.5, .placed = false};
  EXPECT_EQ(somewhere.more_cells({-1.0, 1.0}, {-0.5, 0.5}), 2.0);
}

}  // namespace
}  // namespace coordreq
