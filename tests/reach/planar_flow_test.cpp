#include "reach/planar_flow.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "reach/face_flow.hpp"
#include "reach/reference_flow.hpp"

namespace coordreq {
namespace {

bool applies(const std::vector<std::string>& equations) {
  const FlowCase known(equations);
  const FlowSystem system = known.system();
  const FlowTape tape(system.equations, system.state_slots, system.disturbance_slots);
  return PlanarFlow(system, tape).applies();
}

struct Enclosures {
  FlowEnclosure by_faces;
  FlowEnclosure narrowed;
};

std::optional<Enclosures> enclosures(const FlowCase& known) {
  const FlowSystem system = known.system();
  const FlowTape tape(system.equations, system.state_slots, system.disturbance_slots);
  const VectorField field(system, tape);
  PlanarFlow planar(system, tape);
  Enclosures result;
  const Interval tau{known.tau, known.tau};
  if (!planar.applies() || FaceFlow(system).enclose(known.slots, field, tau, result.by_faces))
    return std::nullopt;
  result.narrowed = result.by_faces;
  planar.narrow(known.slots, tau, result.narrowed);
  return result;
}

TEST(PlanarFlow, IsForTwoStatesThatDisturbancesMultiply) {
  EXPECT_TRUE(applies({"y*w + x*d", "-x + u*d"}));
  EXPECT_TRUE(applies({"y*w*d", "sin(u)*x/3 + abs(v)*d"}));
  EXPECT_TRUE(applies({"-(x*w)", "if(u > 0, 1, 2)*y"}));
  EXPECT_FALSE(applies({"y + w", "-x"}));  // affine
  EXPECT_FALSE(applies({"y*w^2", "-x"}));
  EXPECT_FALSE(applies({"y*w", "-x*y"}));
  EXPECT_FALSE(applies({"y*sin(w)", "-x"}));
  EXPECT_FALSE(applies({"x/w", "-x"}));
  EXPECT_FALSE(applies({"x*w"}));
  EXPECT_FALSE(applies({"y*w", "-x", "z"}));
}

TEST(PlanarFlow, IsNotForLimits) {
  FlowCase known({"y*w", "-x"});
  known.stops.resize(2);
  known.stops[0].above = true;
  const FlowSystem system = known.system();
  const FlowTape tape(system.equations, system.state_slots, system.disturbance_slots);
  EXPECT_FALSE(PlanarFlow(system, tape).applies());
}

TEST(PlanarFlow, WhatTurnsDoesNotGrow) {
  FlowCase known({"3*y + 0.001*w*x", "-3*x"});
  known.tau = 2.0;
  known.slots[0] = {0.95, 1.05};
  known.slots[1] = {-0.05, 0.05};
  known.slots[kDisturbanceSlot] = {-1.0, 1.0};
  const auto found = enclosures(known);
  ASSERT_TRUE(found);
  // A square that turns is no wider than its diagonal.
  EXPECT_LE(width(found->narrowed.end[0]), 0.142);
  EXPECT_LE(width(found->narrowed.end[1]), 0.142);
  EXPECT_GE(width(found->by_faces.end[0]), 1.0);
}

TEST(PlanarFlow, StartsFromAPointToo) {
  FlowCase known({"y*w", "1"});
  known.tau = 1.0;
  known.slots[kDisturbanceSlot] = {-1.0, 1.0};
  const auto found = enclosures(known);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->narrowed.end[0].upper, 0.5, 0.02);
  EXPECT_GE(found->narrowed.end[0].upper, 0.5);
  EXPECT_NEAR(found->narrowed.end[1].lower, 1.0, 1e-9);
  EXPECT_LE(found->narrowed.end[1].lower, 1.0);
}

/// A coefficient with no more than a digit behind the point, times nothing or a disturbance or both.
std::string factor() {
  static const std::vector<std::string> disturbances{"", "", "*w", "*d", "*w*d"};
  return fmt::format("({}){}", *rc::gen::inRange(-30, 31) / 10.0,
                     disturbances[static_cast<std::size_t>(*rc::gen::inRange(0, 5))]);
}

std::string equation() {
  return fmt::format("{}*x + {}*y + {}", factor(), factor(), factor());
}

Interval range(int most, int widest) {
  const double lower = *rc::gen::inRange(-most, most + 1) / 10.0;
  return {lower, lower + *rc::gen::inRange(0, widest + 1) / 10.0};
}

/// Ends of their boxes, or anything between, in up to six pieces.
Signal signal(const FlowCase& known) {
  Signal result(static_cast<std::size_t>(*rc::gen::inRange(1, 7)));
  for (auto& piece : result) {
    for (const std::size_t slot : {kDisturbanceSlot, kDisturbanceSlot + 1}) {
      const long double share = *rc::gen::element(0.0L, 0.0L, 1.0L, 1.0L, 0.3L);
      piece.push_back(known.slots[slot].lower + share * width(known.slots[slot]));
    }
  }
  return result;
}

TEST(PlanarFlow, HoldsSolutionsOfRandomSystems) {
  EXPECT_TRUE(rc::check([] {
    FlowCase known({equation(), equation()});
    known.tau = *rc::gen::inRange(1, 11) / 10.0;
    for (const std::size_t i : {0U, 1U}) known.slots[i] = range(20, 3);
    for (const std::size_t i : {5U, 6U}) known.slots[i] = range(10, 20);
    const auto found = enclosures(known);
    if (!found) return;
    for (int k = 0; k < 12; ++k) {
      std::vector<long double> start;
      for (const std::size_t i : {0U, 1U})
        start.push_back(*rc::gen::element(0.0L, 1.0L, 0.4L) * width(known.slots[i]) + known.slots[i].lower);
      const auto path = integrate(known, start, signal(known), 240);
      for (const std::size_t i : {0U, 1U}) {
        const long double slack = 1e-8L * (1.0L + found->narrowed.tube[i].magnitude());
        RC_ASSERT(path.back()[i] >= found->narrowed.end[i].lower - slack);
        RC_ASSERT(path.back()[i] <= found->narrowed.end[i].upper + slack);
        for (const auto& states : path) {
          RC_ASSERT(states[i] >= found->narrowed.tube[i].lower - slack);
          RC_ASSERT(states[i] <= found->narrowed.tube[i].upper + slack);
        }
      }
    }
  }));
}

}  // namespace
}  // namespace coordreq
