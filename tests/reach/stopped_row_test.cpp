#include <gtest/gtest.h>

#include <algorithm>

#include "reach/attack.hpp"
#include "reach/build_abstraction.hpp"
#include "support/read_system.hpp"

namespace coordreq {
namespace {

std::string rows_spec(const std::string& states, const std::string& equations, const std::string& more = "") {
  return R"({"coordreq": 1, "name": "stopped", "states": [)" + states +
         R"(], "inputs": [{"name": "u", "values": [-4, 0, 4]}], "agents": [{"name": "one", "inputs": ["u"]}], )" +
         more + R"("dynamics": {"time": "continuous", "period": 0.5, "equations": {)" + equations +
         R"(}}, "safe": "true", "abstraction": {"cells": "half_open"}})";
}

Abstraction built(const std::string& text) {
  ThreadTeam team(2);
  return build_abstraction(read_system(text, "test"), team);
}

const std::string kSpeed = R"({"name": "v", "lower": 0, "upper": 20, "step": 2, "outside": "stop"})";

TEST(StoppedRow, AtAFaceAnIntegratorTouchesNoCellMoreThanItReaches) {
  const Abstraction a = built(rows_spec(kSpeed, R"("v": "u")"));
  EXPECT_TRUE(a.exact);
  EXPECT_EQ(a.raw(0, 0, 1), (IndexRange{0, 0}));  // at rest it stays at rest: [0, 1)
  EXPECT_EQ(a.raw(0, 1, 0), (IndexRange{0, 0}));  // braking from [1, 3) to [0, 1)
  EXPECT_EQ(a.raw(0, 0, 0), (IndexRange{0, 0}));
  EXPECT_EQ(a.raw(0, 10, 2), (IndexRange{10, 10}));  // held at the top
  EXPECT_EQ(a.raw(0, 9, 2), (IndexRange{10, 10}));   // from [17, 19) to [19, 20]
  EXPECT_EQ(a.raw(0, 5, 1), (IndexRange{5, 5}));
}

TEST(StoppedRow, ADisturbanceOfTheIntegratorCountsAtBothEnds) {
  const Abstraction a = built(
      rows_spec(kSpeed, R"("v": "u + w")", R"("disturbances": [{"name": "w", "lower": -1, "upper": 1}], )"));
  EXPECT_TRUE(a.exact);
  EXPECT_EQ(a.raw(0, 0, 0), (IndexRange{0, 0}));
  EXPECT_EQ(a.raw(0, 1, 0), (IndexRange{0, 1}));  // from [1, 3) by -1.5 to [0, 1.5)
  EXPECT_EQ(a.raw(0, 5, 1), (IndexRange{4, 6}));  // from [9, 11) by half to both sides
}

/// p' = v, v' = u: how far p gets from 0, by hand.
double moved(double v, double u) {
  constexpr double kPeriod = 0.5;
  const double limit = u < 0 ? 0 : 20;
  const double moving = u == 0 ? kPeriod : std::min(kPeriod, (limit - v) / u);
  return v * moving + u * moving * moving / 2 + (v + u * moving) * (kPeriod - moving);
}

TEST(StoppedRow, WhatFollowsAStoppedIntegratorIsExactToo) {
  const std::string position = R"({"name": "p", "lower": 0, "upper": 20, "step": 0.01}, )";
  const Abstraction a = built(rows_spec(position + kSpeed, R"("p": "v", "v": "u")"));
  EXPECT_TRUE(a.exact);
  const double inputs[] = {-4, 0, 4};
  for (std::int64_t k = 0; k <= 10; ++k) {
    const double speed = 2.0 * static_cast<double>(k);
    for (std::int64_t u = 0; u < 3; ++u) {
      const IndexRange range = a.raw(0, k, u);
      const double low = moved(std::max(speed - 1, 0.0), inputs[u]) - 0.005;
      const double high = moved(std::min(speed + 1, 20.0), inputs[u]) + 0.005;
      // Ends may lie on faces, where doubles cannot tell.
      EXPECT_NEAR(range.first, low / 0.01, 0.51) << speed << " " << inputs[u];
      EXPECT_NEAR(range.last, high / 0.01, 0.51) << speed << " " << inputs[u];
    }
  }
}

TEST(StoppedRow, WhatActsOnAStoppedStateAndOnAnotherIsEnclosed) {
  const std::string position = R"({"name": "p", "lower": 0, "upper": 20, "step": 1}, )";
  const Abstraction a = built(rows_spec(position + kSpeed, R"("p": "v - w", "v": "u + w")",
                                        R"("disturbances": [{"name": "w", "lower": -1, "upper": 1}], )"));
  EXPECT_FALSE(a.exact);
}

TEST(StoppedRow, CellsThatTouchALimitAreNotOffIt) {
  // v follows a, so that it is no integrator; at v = 0 its cell is [0, 0.5), not [-0.5, 0.5).
  const std::string states = R"({"name": "p", "lower": 0, "upper": 3, "step": 0.1},
    {"name": "v", "lower": 0, "upper": 3, "step": 1, "outside": "stop"},
    {"name": "a", "lower": 0, "upper": 1, "step": 1, "discrete": false})";
  const Abstraction a = built(rows_spec(states, R"("p": "v", "v": "a - 0.5", "a": "0")"));
  const std::int64_t cell = 10 * a.grid.stride(0) + 0 * a.grid.stride(1) + 1 * a.grid.stride(2);
  EXPECT_GE(a.raw(0, cell, 1).first, 9);
}

}  // namespace
}  // namespace coordreq
