#include "reach/split_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <utility>

#include "reach/reference_flow.hpp"
#include "support/without.hpp"

namespace coordreq {
namespace {

/// Cells of this step around 0, for all states.
SplitFlow split(const FlowCase& flow, double step, std::int64_t effort, bool placed = true) {
  FlowSystem system = flow.system();
  system.disturbance_slots.clear();
  system.steps.assign(flow.equations.size(), step);
  std::vector<EndCells> targets;
  for (std::size_t i = 0; i < flow.equations.size(); ++i) {
    targets.push_back({.state = i, .step = step, .placed = placed});
  }
  PeriodicFlow whole(system, std::vector<std::optional<Ring>>(flow.equations.size()), flow.tau, flow.tau);
  return {std::move(whole), system, std::move(targets), effort};
}

FlowCase van_der_pol(double x, double y) {
  FlowCase flow({"y", "2*(1 - x^2)*y - x"});
  flow.slots[0] = {x - 0.25, x + 0.25};
  flow.slots[1] = {y - 0.25, y + 0.25};
  flow.tau = 1.0;
  return flow;
}

/// Hull of solutions from a lattice over the box, of ends and of changes.
struct Sampled {
  std::vector<Interval> end, change;
};
Sampled sampled(const FlowCase& flow, int count, int steps) {
  Sampled result;
  for (int a = 0; a < count; ++a) {
    for (int b = 0; b < count; ++b) {
      const auto at = [&](std::size_t i, int k) {
        return static_cast<long double>(flow.slots[i].lower + k * width(flow.slots[i]) / (count - 1));
      };
      const std::vector<long double> start{at(0, a), at(1, b)};
      const std::vector<long double> end = integrate(flow, start, Signal{{0.0L, 0.0L}}, steps).back();
      for (std::size_t i = 0; i < 2; ++i) {
        const Interval value(static_cast<double>(end[i]));
        const Interval change(static_cast<double>(end[i] - start[i]));
        if (result.end.size() < 2) result.end.push_back(value);
        if (result.change.size() < 2) result.change.push_back(change);
        result.end[i] = hull(result.end[i], value);
        result.change[i] = hull(result.change[i], change);
      }
    }
  }
  return result;
}

bool holds(const Interval& outer, const Interval& inner) {
  return outer.lower <= inner.lower + 1e-9 && inner.upper - 1e-9 <= outer.upper;
}

TEST(SplitFlow, FollowsSolutionsThatSpreadToWithinACell) {
  for (const auto& [x, y] : {std::pair(-2.0, 3.0), std::pair(0.0, 0.5), std::pair(1.0, -4.0)}) {
    const FlowCase flow = van_der_pol(x, y);
    const Sampled needed = sampled(flow, 21, 4000);
    const FlowEnclosure found = split(flow, 0.5, 400).flow(flow.slots);
    ASSERT_EQ(found.status, FlowEnclosure::Status::ok);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_TRUE(holds(found.end[i], needed.end[i])) << x << ' ' << y;
      EXPECT_LE(width(found.end[i]), width(needed.end[i]) + 0.5) << x << ' ' << y;
      EXPECT_TRUE(holds(found.drift[i], needed.change[i])) << x << ' ' << y;
      EXPECT_TRUE(holds(found.tube[i], hull(flow.slots[i], needed.end[i])));
    }
  }
}

TEST(SplitFlow, WhatHasNoEnclosureAsAWholeMayHaveOneInParts) {
  FlowCase flow({"1 + x^2*y - 2.5*x", "1.5*x - x^2*y"});
  flow.slots[0] = {2.4375, 2.5625};
  flow.slots[1] = {2.4375, 2.5625};
  flow.tau = 1.0;
  const Sampled needed = sampled(flow, 21, 4000);
  const FlowEnclosure found = split(flow, 0.125, 400).flow(flow.slots);
  ASSERT_EQ(found.status, FlowEnclosure::Status::ok);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(holds(found.end[i], needed.end[i]));
    EXPECT_LE(width(found.end[i]), width(needed.end[i]) + 0.125);
  }
}

TEST(SplitFlow, HowFarAStateMovesIsNotReadOffTheFaces) {
  // Nothing moves at the boundary of the box, everything inside does.
  FlowCase flow({"4*(1 - x^2)*(1 - y^2)", "0*y"});
  flow.slots[0] = {-1.0, 1.0};
  flow.slots[1] = {-1.0, 1.0};
  flow.tau = 0.5;
  const Sampled needed = sampled(flow, 21, 1000);
  EXPECT_GT(needed.change[0].upper, 0.9);
  const FlowEnclosure found = split(flow, 0.01, 100).flow(flow.slots);
  ASSERT_EQ(found.status, FlowEnclosure::Status::ok);
  EXPECT_TRUE(holds(found.drift[0], needed.change[0]));
  EXPECT_LE(found.end[0].upper, 1.0 + 1e-6);  // as the faces show
}

/// The end that is enclosed if it is a summand, and how many sub-steps that took.
std::pair<std::vector<Interval>, std::int64_t> summand(const FlowCase& flow, double step,
                                                       std::int64_t effort) {
  FlowSystem system = flow.system();
  system.disturbance_slots.clear();
  system.steps.assign(flow.equations.size(), step);
  system.summed = true;
  std::vector<EndCells> targets;
  for (std::size_t i = 0; i < flow.equations.size(); ++i)
    targets.push_back({.state = i, .step = step, .placed = false});
  PeriodicFlow whole(system, std::vector<std::optional<Ring>>(flow.equations.size()), flow.tau, flow.tau);
  SplitFlow split(std::move(whole), system, targets, effort);
  const FlowEnclosure found = split.flow(flow.slots);
  EXPECT_EQ(found.status, FlowEnclosure::Status::ok);
  return {found.end, split.steps()};
}

TEST(SplitFlow, TangentsEncloseSummandsInFewerSteps) {
  FlowCase turning({"cos(20*y) - z", "sin(y) + 1", "sin(20*y) + x"});
  turning.slots[1] = {0.0, 1.0};
  FlowCase swaying({"cos(12*y)*exp(z)", "sin(y) + 1", "y*sin(12*y)"});
  swaying.slots[1] = {0.0, 1.0};
  // No effort is enough for it, so that it is divided in short steps, too.
  FlowCase shaking({"sin(30*y)", "sin(y) + 1", "y*sin(30*y)"});
  shaking.slots[1] = {0.0, 1.0};
  for (auto [flow, step, effort] :
       {std::tuple(turning, 0.05, 400), std::tuple(swaying, 0.05, 200), std::tuple(shaking, 0.01, 50)}) {
    flow.tau = 0.5;
    const auto [end, steps] = summand(flow, step, effort);
    const auto [plain, plain_steps] = [&flow = flow, step = step, effort = effort] {
      const FastPath tangents{"tangents", &FastPaths::tangents, false};
      const Without without(tangents);
      return summand(flow, step, effort);
    }();
    EXPECT_TRUE(steps < plain_steps || step < 0.05);
    const auto at = [&flow = flow](std::size_t i, int k) {
      return static_cast<long double>(flow.slots[i].lower + k * width(flow.slots[i]) / 20);
    };
    for (int a = 0; a <= 20; ++a) {
      for (int b = 0; b <= 20; ++b) {
        const auto sample = integrate(flow, {at(0, a), at(1, b), 0.0L}, Signal{{0.0L, 0.0L}}, 400).back();
        for (std::size_t i = 0; i < 3; ++i) {
          EXPECT_TRUE(holds(end[i], Interval(static_cast<double>(sample[i])))) << i;
          EXPECT_TRUE(holds(plain[i], Interval(static_cast<double>(sample[i])))) << i;
        }
      }
    }
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(width(end[i]), width(plain[i]) + 1e-9) << i;
  }
}

TEST(SplitFlow, WithoutEffortItIsTheFlowOfTheWhole) {
  const FlowCase flow = van_der_pol(-2.0, 3.0);
  FlowSystem system = flow.system();
  system.disturbance_slots.clear();
  system.steps.assign(2, 0.5);
  PeriodicFlow whole(system, std::vector<std::optional<Ring>>(2), 1.0, 1.0);
  const FlowEnclosure plain = whole.flow(flow.slots);
  for (const std::int64_t effort : {0, 3}) {  // there are four faces
    const FlowEnclosure found = split(flow, 0.5, effort).flow(flow.slots);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_GE(found.end[i].lower, plain.end[i].lower);
      if (effort > 0) continue;
      EXPECT_EQ(found.end[i].lower, plain.end[i].lower);
      EXPECT_EQ(found.end[i].upper, plain.end[i].upper);
    }
  }
}

TEST(SplitFlow, NothingIsDividedThatMeetsTheCellsOfItsSolutions) {
  const FlowCase flow = van_der_pol(-2.0, 3.0);
  FlowSystem system = flow.system();
  system.disturbance_slots.clear();
  system.steps.assign(2, 1e6);
  PeriodicFlow whole(system, std::vector<std::optional<Ring>>(2), 1.0, 1.0);
  const FlowEnclosure plain = whole.flow(flow.slots);
  const FlowEnclosure found = split(flow, 1e6, 400).flow(flow.slots);
  EXPECT_EQ(found.end[0].upper, plain.end[0].upper);
  EXPECT_EQ(found.end[1].lower, plain.end[1].lower);
}

TEST(SplitFlow, WhereSolutionsMeetAllOfTheBoxIsDivided) {
  // They stop at 1, from which faces alone say nothing; where they start does not tell where they are.
  FlowCase flow({"2 + y^2*x", "0.5*sin(3*x)*y"});
  flow.slots[0] = {-1.0, 1.0};
  flow.slots[1] = {-1.0, 1.0};
  flow.stops.resize(2);
  flow.stops[0] = {.below = false, .above = true, .lower = {}, .upper = Interval(1.0)};
  flow.tau = 1.0;
  SplitFlow divided = split(flow, 0.05, 200);
  const FlowEnclosure found = divided.flow(flow.slots);
  ASSERT_EQ(found.status, FlowEnclosure::Status::ok);
  for (int a = 0; a <= 20; ++a) {
    for (int b = 0; b <= 20; ++b) {
      double x = -1.0 + 0.1 * a;
      double y = -1.0 + 0.1 * b;
      for (int k = 0; k < 2000; ++k) {
        const double rate = 0.5 * std::sin(3.0 * x) * y;
        x = std::min(1.0, x + (2.0 + y * y * x) / 2000);
        y += rate / 2000;
      }
      EXPECT_GE(x, found.end[0].lower - 1e-3);
      EXPECT_LE(y, found.end[1].upper + 1e-3);
      EXPECT_GE(y, found.end[1].lower - 1e-3);
    }
  }
}

TEST(SplitFlow, TwiceTheSameIsTheSame) {
  const FlowCase flow = van_der_pol(0.0, 0.5);
  SplitFlow divided = split(flow, 0.5, 100);
  const FlowEnclosure first = divided.flow(flow.slots);
  (void)divided.flow(van_der_pol(1.0, -4.0).slots);
  const FlowEnclosure again = divided.flow(flow.slots);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(first.end[i].lower, again.end[i].lower);
    EXPECT_EQ(first.end[i].upper, again.end[i].upper);
    EXPECT_EQ(first.tube[i].upper, again.tube[i].upper);
  }
}

}  // namespace
}  // namespace coordreq
