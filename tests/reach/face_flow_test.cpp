#include "reach/face_flow.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "reach/random_flow.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

std::optional<FlowEnclosure> by_faces(const FlowCase& known) {
  const FlowSystem system = known.system();
  const FlowTape tape(system.equations, system.state_slots, system.disturbance_slots);
  const VectorField field(system, tape);
  FlowEnclosure result;
  if (FaceFlow(system).enclose(known.slots, field, {known.tau, known.tau}, result)) return std::nullopt;
  return result;
}

TEST(FaceFlow, FollowsTheExtremesOfOneStateUnderAnyDisturbance) {
  // The upper end grows by w = 2, 4 - 2x, until x = 1, then by w = -1, 1 + x; the lower one falls by w = x
  // / 2.
  FlowCase system({"w^2 - w*x"});
  system.tau = 1.0;
  system.slots[0] = {-0.05, 0.05};
  system.slots[kDisturbanceSlot] = {-1.0, 2.0};
  const auto found = by_faces(system);
  ASSERT_TRUE(found);
  const double switched = 0.5 * std::log(1.95);
  const double highest = 2.0 * std::exp(1.0 - switched) - 1.0;
  EXPECT_GE(found->end[0].upper, highest);
  EXPECT_LE(found->end[0].upper, highest + 0.02);
  EXPECT_LE(found->end[0].lower, -0.05);
  EXPECT_GE(found->end[0].lower, -0.07);
}

TEST(FaceFlow, StepsAreLongerThanWhatDecays) {
  FlowCase system({"-1e8*(x - sin(y))", "1"});
  system.tau = 1.0;
  system.slots[0] = {-1.0, 1.0};
  const auto found = by_faces(system);
  ASSERT_TRUE(found);
  EXPECT_LE(found->end[0].lower, std::sin(1.0));
  EXPECT_GE(found->end[0].upper, std::sin(1.0));
  EXPECT_LE(width(found->end[0]), 0.01);
}

TEST(FaceFlow, FrictionBringsToRest) {
  FlowCase system({"-0.5*sign(x)"});
  system.tau = 1.0;
  system.slots[0] = {0.1, 0.2};
  const auto found = by_faces(system);
  ASSERT_TRUE(found);
  EXPECT_LE(found->end[0].lower, 0.0);
  EXPECT_GE(found->end[0].upper, 0.0);
  EXPECT_LE(width(found->end[0]), 1e-9);
}

TEST(FaceFlow, StoppedStatesGoOnFromTheirLimit) {
  // Down to the limit 0, and up again from there when y has become positive.
  FlowCase system({"y", "2"});
  system.tau = 1.0;
  system.slots[0] = {0.05, 0.05};
  system.slots[1] = {-1.0, -1.0};
  system.stops.resize(2);
  system.stops[0] = {true, false, {0.0, 0.0}, {}};
  const auto found = by_faces(system);
  ASSERT_TRUE(found);
  EXPECT_GE(found->end[0].upper, 0.25);
  EXPECT_GE(found->end[0].lower, 0.0);
}

TEST(FaceFlow, SaysWhichStateEscapes) {
  FlowCase system({"1", "y^2"});
  system.tau = 1.0;
  system.slots[1] = {1.5, 1.5};
  EXPECT_FALSE(by_faces(system));
}

/// Every solution stays in what is found.
void attack_faces(const FlowCase& system, long double tolerance) {
  const auto found = by_faces(system);
  if (!found) return;
  for (int k = 0; k < 4; ++k) {
    const std::vector<long double> start = random_start(system);
    const Signal signal = random_signal(system);
    const auto path = integrate(system, start, signal, 420);
    const auto coarse = integrate(system, start, signal, 210);
    for (std::size_t i = 0; i < found->end.size(); ++i) {
      const long double error = tolerance + 2.0L * std::fabs(path.back()[i] - coarse.back()[i]);
      const auto holds = [&](const Interval& range, long double value) {
        const long double slack = error * (1.0L + std::fabs(value));
        return range.lower - slack <= value && value <= range.upper + slack;
      };
      RC_ASSERT(holds(found->end[i], path.back()[i]));
      for (const auto& states : path) {
        RC_ASSERT(holds(found->tube[i], states[i]));
        RC_ASSERT(holds(found->drift[i], states[i] - path.front()[i]));
      }
    }
  }
}

TEST(FaceFlow, HoldsSolutionsOfRandomSystems) {
  EXPECT_TRUE(rc::check([] {
    for (int n = 0; n < 4; ++n) attack_faces(random_case(Roughness::lipschitz), 1e-8L);
    attack_faces(random_case(Roughness::discontinuous), 0.02L);
  }));
}

}  // namespace
}  // namespace coordreq
