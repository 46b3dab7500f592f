#include "answers/counterexample/nominal_run.hpp"

#include <gtest/gtest.h>

#include "reach/build_abstraction.hpp"
#include "spec/problem_spec.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

Rational whole_power(unsigned long base, unsigned long exponent) {
  mpz_class result;
  mpz_ui_pow_ui(result.get_mpz_t(), base, exponent);
  return Rational(result);
}

/// Its numbers are longer than those that are kept exact, and no double is near it.
TEST(NominalRun, AStateBeyondAllDoublesIsFollowedAsWell) {
  const ProblemSpec spec = read_spec(R"({"coordreq": 1, "name": "far",
    "states": [{"name": "x", "lower": 0, "upper": 4, "step": 1}],
    "inputs": [{"name": "u", "values": [0, 1]}], "agents": [{"name": "a", "inputs": ["u"]}],
    "dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x/3 + u"}}, "safe": "true"})",
                                     "far");
  ThreadTeam team(1);
  const Abstraction abstraction = build_abstraction(spec, team);
  NominalRun run(spec, abstraction);
  const Rational far = whole_power(10, 400) + 1 / whole_power(3, 3000);
  run.start(std::vector<Rational>{far});
  const NominalRun::Successor successor = run.after(0, 0);
  EXPECT_TRUE(successor.is_known);
  EXPECT_EQ(successor.kind, Location::Kind::beyond);
}

}  // namespace
}  // namespace coordreq
