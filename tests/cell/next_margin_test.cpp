#include "cell/next_margin.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "cell/random_stream.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/problem_spec.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

ProblemSpec pair_spec(const std::string& safe) {
  return read_spec(R"({"coordreq": 1, "name": "t",
"states": [{"name": "x", "lower": 0, "upper": 9, "step": 1}, {"name": "y", "lower": 0, "upper": 9, "step": 1}],
"inputs": [{"name": "u", "values": [-1, "-1/3", 0, 1]}, {"name": "v", "values": [-1, 0, 1]}, {"name": "rest", "values": [0, 1]}],
"agents": [{"name": "a", "inputs": ["u", "rest"]}, {"name": "b", "inputs": ["v"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + u", "y": "y + v"}},
"safe": ")" + safe + "\"}",
                   "test");
}

class NextMargins : public testing::TestWithParam<const char*> {};

/// Of some candidates the one with the smallest margin, one at a time.
TEST_P(NextMargins, TheSmallestIsThatOfSingleMargins) {
  const ProblemSpec spec = pair_spec(GetParam());
  ThreadTeam team(1);
  const Abstraction abstraction = build_abstraction(spec, team);
  PointDynamics dynamics(spec);
  NextStates next(spec, abstraction, dynamics);
  NextMargin margin(spec, abstraction.inputs, dynamics);
  Margin single(spec.safe);
  RandomStream random(3, 0, RandomStream::Purpose::start);
  for (int k = 0; k < 300; ++k) {
    const std::vector<Rational> state = {Rational(static_cast<long>(random.below(28))) / 3,
                                         Rational(static_cast<long>(random.below(28))) / 3};
    next.begin(state, std::vector<Rational>{}, std::vector<Rational>{0, 0}, 0);
    std::vector<std::int64_t> candidates;
    for (std::int64_t u = 0; u < abstraction.inputs.count(); ++u) {
      if (random.below(3) > 0) candidates.push_back(u);
    }
    if (candidates.empty()) continue;
    double least = std::numeric_limits<double>::infinity();
    std::int64_t expected = candidates.front();
    for (const std::int64_t u : candidates) {
      std::vector<Rational> slots(spec.slot_count());
      for (std::size_t i = 0; i < 2; ++i) slots[spec.state_slot(i)] = next.state(i, u).value;
      const double found = single.value(slots);
      if (found < least) expected = u;
      least = std::min(least, found);
    }
    ASSERT_EQ(margin.smallest(next, candidates), expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Conditions, NextMargins,
                         testing::Values("x >= 2", "x >= 2 and x <= 7 and abs(y - 4) <= 3",
                                         "abs(x - y) >= 1 or x + y >= 9", "not (x < 3 and y < 3)", "true",
                                         "x >= 2 and sqrt(y) <= 2.5"));

}  // namespace
}  // namespace coordreq
