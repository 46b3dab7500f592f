#include "spec/state_bounds.hpp"

#include <gtest/gtest.h>

#include <string>

#include "spec/problem_spec.hpp"
#include "spec/read_spec.hpp"

namespace coordreq {
namespace {

std::vector<StateBound> bounds(const std::string& safe) {
  const ProblemSpec spec = read_spec(R"({"coordreq": 1, "name": "t", "constants": {"top": 24},
"states": [{"name": "T", "lower": 0, "upper": 30, "step": 1}, {"name": "p", "lower": -9, "upper": 9, "step": 1}],
"inputs": [{"name": "u", "values": [0]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"T": "T", "p": "p + u"}}, "safe": ")" +
                                         safe + R"("})",
                                     "test");
  return state_bounds(spec.safe, spec.states.size());
}

TEST(StateBounds, AreComparisonsOfAStateWithANumber) {
  const std::vector<StateBound> found = bounds("18 <= T <= top and p > -2");
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].state, 0U);
  EXPECT_EQ(found[0].value, Rational(18));
  EXPECT_FALSE(found[0].is_upper);
  EXPECT_EQ(found[1].value, Rational(24));
  EXPECT_TRUE(found[1].is_upper);
  EXPECT_EQ(found[2].state, 1U);
  EXPECT_EQ(found[2].value, Rational(-2));
  EXPECT_FALSE(found[2].is_upper);
}

TEST(StateBounds, AreDemandedByTheWholeCondition) {
  EXPECT_TRUE(bounds("T <= 24 or p > 1").empty());
  EXPECT_TRUE(bounds("not (T <= 24)").empty());
  EXPECT_TRUE(bounds("T + p <= 24 and abs(p) < 3").empty());
  EXPECT_TRUE(bounds("T == 24").empty());
}

}  // namespace
}  // namespace coordreq
