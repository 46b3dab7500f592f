#include "cell/next_states.hpp"

#include <gtest/gtest.h>

#include <string>

#include "cell/random_stream.hpp"
#include "model/sample_reset.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// A vehicle whose cells have faces at 0.05 + k/10; what happens at the ends of p is up to the test.
ProblemSpec vehicle(const std::string& ends) {
  return read_spec(R"({"coordreq": 1, "name": "t",
"states": [{"name": "p", "lower": -1, "upper": 1, "step": 0.1, "outside": )" +
                       ends + R"(},
           {"name": "v", "lower": -1, "upper": 1, "step": 0.1, "outside": "unsafe", "measurement_error": 0.05}],
"inputs": [{"name": "a", "values": [-0.3, 0, 0.1]}, {"name": "b", "values": [0, 0.2]}],
"disturbances": [{"name": "w", "lower": -0.1, "upper": 0.1}],
"agents": [{"name": "one", "inputs": ["a"]}, {"name": "two", "inputs": ["b"]}],
"dynamics": {"time": "continuous", "period": 0.1, "equations": {"p": "v", "v": "a - b + w"}},
"safe": "true", "abstraction": {"cells": "half_open"}})",
                   "test");
}

class NextStatesByEstimate : public testing::TestWithParam<const char*> {};

/// Starts are multiples of 1/400, so that many next states lie on faces.
TEST_P(NextStatesByEstimate, AreMeasuredWhereExactOnesAre) {
  const ProblemSpec spec = vehicle(GetParam());
  ThreadTeam team(1);
  const Abstraction abstraction = build_abstraction(spec, team);
  const UniformGrid& grid = abstraction.grid;
  PointDynamics dynamics(spec), others(spec);
  NextStates next(spec, abstraction, dynamics);
  RandomStream random(7, 0, RandomStream::Purpose::start);
  const auto multiple = [&random](std::int64_t most) -> Rational {
    return Rational(static_cast<long>(random.below(static_cast<std::uint64_t>(2 * most + 1))) - most) / 400;
  };
  int at_faces = 0;
  for (int k = 0; k < 2000; ++k) {
    const std::vector<Rational> state = {multiple(420), multiple(420)};
    const std::vector<Rational> w = {multiple(40)};
    const std::vector<Rational> error = {0, multiple(20)};
    next.begin(state, w, error, 0);
    for (std::int64_t u = 0; u < abstraction.inputs.count(); ++u) {
      std::vector<Rational> slots = state, measured;
      for (std::size_t i = 0; i < 2; ++i)
        slots.push_back(
            abstraction.inputs[i].values[static_cast<std::size_t>(abstraction.inputs.index(u, i))]);
      slots.push_back(w.front());
      for (std::size_t i = 0; i < 2; ++i) {
        measured.push_back(reset_at_sample(grid[i], others.next(i, slots).value()) + error[i]);
        at_faces += is_integer((measured[i] - grid[i].first) / grid[i].step + Rational(1) / 2) ? 1 : 0;
      }
      const Location location = locate(grid, measured);
      const NextStates::Place place = next.place(u);
      ASSERT_EQ(place.kind, location.kind);
      ASSERT_EQ(place.cell, location.cell);
      EXPECT_TRUE(next.is_known(u));
      for (std::size_t i = 0; i < 2; ++i) ASSERT_EQ(next.state(i, u).value + error[i], measured[i]);
    }
  }
  EXPECT_GT(at_faces, 20);
}

INSTANTIATE_TEST_SUITE_P(Ends, NextStatesByEstimate,
                         testing::Values("\"unsafe\"", "\"safe\"", "\"saturate\"", "\"stop\""));

TEST(NextStates, InputsOfEqualNumberLeadToEqualStates) {
  const ProblemSpec spec = vehicle("\"unsafe\"");
  ThreadTeam team(1);
  const Abstraction abstraction = build_abstraction(spec, team);
  PointDynamics dynamics(spec);
  NextStates next(spec, abstraction, dynamics);
  next.begin(std::vector<Rational>{0, 0}, std::vector<Rational>{0}, std::vector<Rational>{0, 0}, 0);
  for (std::int64_t u = 0; u < abstraction.inputs.count(); ++u) EXPECT_EQ(next.inputs_of(1, u), u);
}

}  // namespace
}  // namespace coordreq
