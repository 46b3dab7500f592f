#include "reach/validated_flow.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "reach/flow_helpers.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

using Status = FlowEnclosure::Status;

void expect_hull(const Interval& range, double lower, double upper, double tolerance) {
  EXPECT_LE(range.lower, lower + 1e-15 * std::fabs(lower));
  EXPECT_GE(range.upper, upper - 1e-15 * std::fabs(upper));
  EXPECT_NEAR(range.lower, lower, tolerance);
  EXPECT_NEAR(range.upper, upper, tolerance);
}

/// A vehicle at position x with speed y, acceleration u and drag.
FlowCase vehicle(const Interval& speed, double acceleration) {
  FlowCase result({"y", "u - 0.2*y^2"});
  result.tau = 0.2;
  result.slots[0] = {1.0, 1.1};
  result.slots[1] = speed;
  result.slots[3] = {acceleration, acceleration};
  return result;
}

/// Solution of v' = a - k v^2 for a, k > 0 (and its integral).
struct Drag {
  double a;
  double k;

  [[nodiscard]] double speed(double v, double t) const {
    return top() * std::tanh(std::atanh(v / top()) + rate() * t);
  }
  [[nodiscard]] double distance(double v, double t) const {
    // Integral of tanh is log cosh; beyond the top speed tanh becomes coth and cosh becomes sinh.
    return std::log(std::cosh(rate() * t) + v / top() * std::sinh(rate() * t)) / k;
  }
  [[nodiscard]] double speed_above(double v, double t) const {
    const double offset = 0.5 * std::log((v / top() + 1.0) / (v / top() - 1.0));
    return top() / std::tanh(offset + rate() * t);
  }
  [[nodiscard]] double top() const { return std::sqrt(a / k); }
  [[nodiscard]] double rate() const { return std::sqrt(a * k); }
};

TEST(ValidatedFlow, VehicleWithDragHasItsExactHull) {
  const FlowEnclosure post = vehicle({2.75, 2.85}, 1.0).enclosure();
  ASSERT_EQ(post.status, Status::ok);
  const Drag drag{1.0, 0.2};
  expect_hull(post.end[1], drag.speed_above(2.75, 0.2), drag.speed_above(2.85, 0.2), 1e-8);
  expect_hull(post.end[0], 1.0 + drag.distance(2.75, 0.2), 1.1 + drag.distance(2.85, 0.2), 1e-8);
  const FlowEnclosure slow = vehicle({0.05, 0.15}, 1.0).enclosure();
  expect_hull(slow.end[1], drag.speed(0.05, 0.2), drag.speed(0.15, 0.2), 1e-8);
}

TEST(ValidatedFlow, TubeOfAOneWayMotionIsExact) {
  const FlowEnclosure post = vehicle({2.75, 2.85}, 1.0).enclosure();
  expect_hull(post.tube[0], 1.0, post.end[0].upper, 1e-15);
  expect_hull(post.tube[1], post.end[1].lower, 2.85, 1e-15);
}

FlowCase with_stop(FlowCase system) {
  system.stops.resize(2);
  system.stops[1] = {true, true, {0.0, 0.0}, {3.0, 3.0}};
  return system;
}

TEST(ValidatedFlow, VehicleThatBrakesToAStandstillDoesNotReverse) {
  // v' = -1 - k v^2 stops at t0 = atan(v sqrt k) / sqrt k after log(1 + k v^2) / (2 k).
  const FlowEnclosure post = with_stop(vehicle({0.05, 0.15}, -1.0)).enclosure();
  ASSERT_EQ(post.status, Status::ok);
  EXPECT_EQ(post.end[1].lower, 0.0);
  EXPECT_EQ(post.end[1].upper, 0.0);
  const auto distance = [](double v) { return std::log(1.0 + 0.2 * v * v) / 0.4; };
  expect_hull(post.end[0], 1.0 + distance(0.05), 1.1 + distance(0.15), 2e-6);
  EXPECT_EQ(post.tube[1].lower, 0.0);
}

TEST(ValidatedFlow, HalfCellBeyondALimitIsNotOccupied) {
  const FlowEnclosure post = with_stop(vehicle({-0.05, 0.05}, 1.0)).enclosure();
  const Drag drag{1.0, 0.2};
  expect_hull(post.end[1], drag.speed(0.0, 0.2), drag.speed(0.05, 0.2), 1e-8);
}

TEST(ValidatedFlow, UpperLimitHolds) {
  const FlowEnclosure post = with_stop(vehicle({2.95, 3.05}, 2.0)).enclosure();
  EXPECT_EQ(post.end[1].upper, 3.0);
  expect_hull(post.end[0], 1.0 + Drag{2.0, 0.2}.distance(2.95, 0.2), 1.1 + 0.6, 1e-5);
}

TEST(ValidatedFlow, LimitThatIsNoDoubleIsKept) {
  FlowCase system({"u"});
  system.slots[0] = {0.05, 0.15};
  system.slots[3] = {-1.0, -1.0};
  system.tau = 0.5;
  const double above = 0.1;  // 1/10 lies between the double below and this one
  system.stops = {{true, false, {std::nextafter(above, 0.0), above}, {}}};
  const FlowEnclosure post = system.enclosure();
  EXPECT_EQ(post.end[0].lower, std::nextafter(above, 0.0));
  EXPECT_EQ(post.end[0].upper, above);
}

void expect_fails(const FlowCase& system, Status status, std::size_t culprit) {
  const auto start = std::chrono::steady_clock::now();
  const FlowEnclosure post = system.enclosure();
  EXPECT_EQ(post.status, status);
  EXPECT_EQ(post.culprit, culprit);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
  for (const Interval& range : post.tube) EXPECT_LE(range.lower, range.upper);
}

TEST(ValidatedFlow, FiniteEscapeNamesItsEquation) {
  FlowCase system({"1", "y^2"});
  system.tau = 1.0;
  system.slots[1] = {0.5, 1.5};
  expect_fails(system, Status::blows_up, 1);
  system.slots[1] = {-3.0, 1000.0};
  expect_fails(system, Status::blows_up, 1);
  system.slots[1] = {0.5, 0.95};
  EXPECT_EQ(system.enclosure().status, Status::ok);
}

TEST(ValidatedFlow, EscapeTellsHowFarItCame) {
  FlowCase system({"x^2"});
  system.tau = 1.0;
  system.slots[0] = {1.5, 1.5};
  EXPECT_GT(system.enclosure().tube[0].upper, 1e4);
}

TEST(ValidatedFlow, UndefinedRightHandSidesNameTheirEquation) {
  FlowCase inverse({"y", "1/y"});
  inverse.slots[1] = {-0.5, 0.5};
  expect_fails(inverse, Status::undefined, 1);
  inverse.slots[1] = {0.01, 0.5};
  EXPECT_EQ(inverse.enclosure().status, Status::ok);

  FlowCase root({"sqrt(x) - 1"});
  root.slots[0] = {-0.25, 0.5};
  expect_fails(root, Status::undefined, 0);

  // Leaves the domain of the logarithm on its way.
  FlowCase sinking({"-1 + 0*log(x)"});
  sinking.slots[0] = {0.05, 0.1};
  expect_fails(sinking, Status::undefined, 0);
}

TEST(ValidatedFlow, StiffSystemsAreEnclosed) {
  FlowCase system({"-1000*(x - y)", "-y"});
  system.slots[0] = {1.0, 2.0};
  system.slots[1] = {1.0, 1.1};
  const FlowEnclosure post = system.enclosure();
  ASSERT_EQ(post.status, Status::ok);
  expect_hull(post.end[0], std::exp(-0.1) / 0.999, 1.1 * std::exp(-0.1) / 0.999, 1e-9);
}

TEST(ValidatedFlow, TankRunsEmptyWithoutANegativeLevel) {
  // The slope of the root is unbounded at 0, and so is the decay of differences, which does no harm.
  FlowCase system({"-sqrt(max(x, 0))"});
  system.slots[0] = {0.0, 0.04};
  const FlowEnclosure post = system.enclosure();
  ASSERT_EQ(post.status, Status::ok);
  expect_hull(post.end[0], 0.0, 0.15 * 0.15, 1e-6);  // sqrt x falls by t / 2
}

TEST(ValidatedFlow, SwitchingIsEnclosed) {
  FlowCase system({"y", "if(x > 0, -1, 1)"});
  system.slots[0] = {-0.1, 0.1};
  system.slots[1] = {0.5, 0.6};
  const FlowEnclosure post = system.enclosure();
  ASSERT_EQ(post.status, Status::ok);
  expect_hull(post.end[1], 0.4, 0.7, 1e-12);
  EXPECT_LE(width(post.end[0]), 0.2201);
}

TEST(ValidatedFlow, LongChainsOfIntegratorsHaveTheirExactHull) {
  // More variables than one pass of differentiation takes.
  constexpr std::uint32_t kStates = 11;
  std::vector<Program> equations;
  const auto look_up = [](std::string_view name) -> Binding {
    return static_cast<std::uint32_t>(std::stoul(std::string(name.substr(1))));
  };
  for (std::uint32_t i = 0; i < kStates; ++i) {
    const std::string text = i + 1 < kStates ? "s" + std::to_string(i + 1) : "1";
    equations.push_back(link(text, look_up, ExpectedType::number, "/dynamics"));
  }
  FlowSystem system;
  double sum = 0.0;
  double term = 1.0;
  for (std::uint32_t i = 0; i < kStates; ++i) {
    system.equations.push_back(&equations[i]);
    system.state_slots.push_back(i);
    sum += term;
    term /= i + 1.0;
  }
  system.slot_count = kStates;
  ValidatedFlow flow(system, 1.0, 1.0);
  const FlowEnclosure post = flow.flow(std::vector<Interval>(kStates, Interval{0.0, 1.0}));
  ASSERT_EQ(post.status, Status::ok);
  expect_hull(post.end[0], term, sum + term, 1e-14);
}

TEST(ValidatedFlow, PeriodMayLieBetweenTwoDoubles) {
  FlowCase system({"1"});
  system.slots[0] = {0.0, 0.0};
  ValidatedFlow flow(system.system(), 0.09375, 0.125);
  const FlowEnclosure post = flow.flow(system.slots);
  EXPECT_EQ(post.end[0].lower, 0.09375);
  EXPECT_EQ(post.end[0].upper, 0.125);
}

TEST(ValidatedFlow, CopiesWorkOnTheirOwn) {
  const FlowCase system = vehicle({1.0, 1.1}, 1.0);
  ValidatedFlow original = system.validated();
  ValidatedFlow copy = original;
  const double first = original.flow(system.slots).end[0].upper;
  original = vehicle({1.0, 1.1}, -1.0).validated();
  EXPECT_EQ(copy.flow(system.slots).end[0].upper, first);
}

}  // namespace
}  // namespace coordreq
