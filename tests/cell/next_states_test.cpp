#include "cell/next_states.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/index.hpp"
#include "cell/random_stream.hpp"
#include "model/sample_reset.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

/// A vehicle; what happens at the ends of p is up to the test.
ProblemSpec vehicle(const std::string& ends) {
  const std::string points = ends == "\"periodic\"" ? R"("count": 20)" : R"("step": 0.1)";
  return read_spec(R"({"coordreq": 1, "name": "t",
"states": [{"name": "p", "lower": -1, "upper": 1, )" +
                       points + R"(, "outside": )" + ends + R"(},
           {"name": "v", "lower": -1, "upper": 1, "step": 0.1, "outside": "unsafe", "measurement_error": 0.05}],
"inputs": [{"name": "a", "values": [-0.3, 0, 0.1]}, {"name": "b", "values": [0, 0.2]}],
"disturbances": [{"name": "w", "lower": -0.1, "upper": 0.1}],
"agents": [{"name": "one", "inputs": ["a"]}, {"name": "two", "inputs": ["b"]}],
"dynamics": {"time": "continuous", "period": 0.1, "equations": {"p": "v", "v": "a - b + w"}},
"safe": "true", "abstraction": {"cells": "half_open"}})",
                   "test");
}

/// Next states one at a time, by exact arithmetic alone.
class ExactVehicle {
 public:
  ExactVehicle(const ProblemSpec& spec, const Abstraction& abstraction)
      : abstraction_(abstraction), dynamics_(spec) {}

  [[nodiscard]] Rational next(std::size_t i, std::vector<Rational> state, const Rational& w, std::int64_t u) {
    const InputSpace& inputs = abstraction_.inputs;
    for (std::size_t j = 0; j < 2; ++j) state.push_back(inputs[j].values[at(inputs.index(u, j))]);
    state.push_back(w);
    return reset_at_sample(abstraction_.grid[i], dynamics_.next(i, state).value());
  }

  /// A start from which both states are measured on faces of these numbers under `u`.
  [[nodiscard]] std::vector<Rational> start_before(const std::vector<std::int64_t>& faces, const Rational& w,
                                                   const std::vector<Rational>& error, std::int64_t u) {
    std::vector<Rational> state = {0, 0};
    for (const std::size_t i : {std::size_t{1}, std::size_t{0}})  // p moves by v
      state[i] = face(i, faces[i]) - error[i] - next(i, state, w, u);
    return state;
  }

  /// Between the cells k - 1 and k.
  [[nodiscard]] Rational face(std::size_t i, std::int64_t k) const {
    const GridDimension& dimension = abstraction_.grid[i];
    return dimension.point(k) - dimension.step / 2;
  }

 private:
  const Abstraction& abstraction_;
  PointDynamics dynamics_;
};

class NextStatesByEstimate : public testing::TestWithParam<const char*> {};

/// From every start both states are on faces under one joint input, and wherever they are under the others.
TEST_P(NextStatesByEstimate, AreMeasuredWhereExactOnesAre) {
  constexpr int kStarts = 2000;
  const ProblemSpec spec = vehicle(GetParam());
  ThreadTeam team(1);
  const Abstraction abstraction = build_abstraction(spec, team);
  const UniformGrid& grid = abstraction.grid;
  PointDynamics dynamics(spec);
  NextStates next(spec, abstraction, dynamics);
  ExactVehicle exact(spec, abstraction);
  RandomStream random(7, 0, RandomStream::Purpose::start);
  const auto below = [&random](std::int64_t count) {
    return static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(count)));
  };
  const auto multiple = [&below](std::int64_t most) -> Rational {
    return Rational(static_cast<long>(below(2 * most + 1) - most)) / 400;
  };
  std::vector<int> at_faces = {0, 0};
  for (int k = 0; k < kStarts; ++k) {
    const Rational w = multiple(40);
    const std::vector<Rational> error = {0, multiple(20)};
    // 2 to 18: what moves p by 0.1 does not bring it to an end.
    const std::vector<Rational> state =
        exact.start_before({2 + below(17), 2 + below(17)}, w, error, below(abstraction.inputs.count()));
    next.begin(state, std::vector<Rational>{w}, error, 0);
    for (std::int64_t u = 0; u < abstraction.inputs.count(); ++u) {
      std::vector<Rational> measured;
      for (std::size_t i = 0; i < 2; ++i) {
        measured.push_back(exact.next(i, state, w, u) + error[i]);
        at_faces[i] += is_integer((measured[i] - exact.face(i, 0)) / grid[i].step) ? 1 : 0;
      }
      const Location location = locate(grid, measured);
      const NextStates::CellLocation measured_at = next.location(u);
      ASSERT_EQ(measured_at.kind, location.kind);
      ASSERT_EQ(measured_at.cell, location.cell);
      EXPECT_TRUE(next.is_known(u));
      for (std::size_t i = 0; i < 2; ++i) ASSERT_EQ(next.state(i, u).value + error[i], measured[i]);
    }
  }
  EXPECT_GE(at_faces[1], kStarts);
  // With `stop` p is followed in double arithmetic, which leads beside most faces.
  EXPECT_GE(at_faces[0], GetParam() == std::string("\"stop\"") ? 1 : kStarts);
}

INSTANTIATE_TEST_SUITE_P(Ends, NextStatesByEstimate,
                         testing::Values("\"unsafe\"", "\"safe\"", "\"saturate\"", "\"stop\"",
                                         "\"periodic\""));

}  // namespace
}  // namespace coordreq
