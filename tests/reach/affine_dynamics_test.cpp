#include "reach/affine_dynamics.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "support/read_system.hpp"

namespace coordreq {
namespace {

/// A spec with states p, v (continuous), one input u, one disturbance w in [-1, 3].
SystemSpec spec_with(const std::string& time, const std::string& p, const std::string& v,
                     const std::string& period = "0.5") {
  return read_system(R"({"coordreq": 1, "name": "t",
"states": [{"name": "p", "lower": 0, "upper": 9, "step": 1}, {"name": "v", "lower": 0, "upper": 9, "step": 1}],
"inputs": [{"name": "u", "values": [2]}], "disturbances": [{"name": "w", "lower": -1, "upper": 3}],
"agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": ")" +
                         time + R"(", "period": )" + period + R"(, "equations": {"p": ")" + p +
                         R"(", "v": ")" + v + R"("}}, "safe": "true"})",
                     "test");
}

SampledRow row_of(const SystemSpec& spec, std::size_t state) {
  return AffineDynamics(spec).row(state, {0, 0, 2, 0}).value();
}

TEST(AffineDynamics, DoubleIntegratorIsSolvedExactly) {
  const SampledRow row = row_of(spec_with("continuous", "v", "u"), 0);
  ASSERT_EQ(row.coefficient.size(), 2U);
  EXPECT_EQ(row.coefficient[0], Rational(1));
  EXPECT_EQ(row.coefficient[1], Rational(1, 2));
  EXPECT_EQ(row.lower, Rational(1, 4));  // u tau^2 / 2
  EXPECT_EQ(row.upper, Rational(1, 4));
  EXPECT_TRUE(row.exact);
}

TEST(AffineDynamics, DisturbanceIsIntegratedThroughTheChain) {
  // v' = w: p moves by the integral of (tau - s) w, between -tau^2/2 and 3 tau^2/2.
  const SampledRow row = row_of(spec_with("continuous", "v", "w"), 0);
  EXPECT_EQ(row.lower, Rational(-1, 8));
  EXPECT_EQ(row.upper, Rational(3, 8));
  EXPECT_TRUE(row.exact);
}

TEST(AffineDynamics, DisturbanceThatActsWithBothSignsIsBounded) {
  // p' = v - w/4, v' = w: kernel s - 1/4 on [0, 1/2] changes its sign in the middle; its integral is 0 and
  // that of its absolute value 1/16; w = 1 +- 2.
  const SampledRow row = row_of(spec_with("continuous", "v - w/4", "w"), 0);
  EXPECT_EQ(row.lower, Rational(-1, 8));
  EXPECT_EQ(row.upper, Rational(1, 8));
  EXPECT_TRUE(row.exact);
}

TEST(AffineDynamics, DiscreteMapsAreMultipliedOut) {
  const SampledRow row = row_of(spec_with("discrete", "p*(1 + v) - v*p + u*w", "v/4"), 0);
  EXPECT_EQ(row.coefficient[0], Rational(1));
  EXPECT_EQ(row.lower, Rational(-2));
  EXPECT_EQ(row.upper, Rational(6));
}

TEST(AffineDynamics, OnlyWhatTheEquationUsesIsADependency) {
  const SystemSpec spec = spec_with("discrete", "v + w", "v + u");
  const AffineDynamics dynamics(spec);
  EXPECT_EQ(dynamics.dependencies(0).moving, (std::vector<std::int32_t>{1}));
  EXPECT_TRUE(dynamics.dependencies(0).inputs.empty());
  EXPECT_EQ(dynamics.dependencies(0).disturbances, (std::vector<std::int32_t>{0}));
  EXPECT_TRUE(dynamics.dependencies(1).disturbances.empty());
}

TEST(AffineDynamics, ContinuousTimeDependsOnTheTransitiveClosure) {
  const SystemSpec spec = spec_with("continuous", "v", "u + w");
  const AffineDynamics dynamics(spec);
  EXPECT_EQ(dynamics.dependencies(0).moving, (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(dynamics.dependencies(0).inputs, (std::vector<std::int32_t>{0}));
  EXPECT_EQ(dynamics.dependencies(0).disturbances, (std::vector<std::int32_t>{0}));
}

TEST(AffineDynamics, IrrationalConstantsAreEnclosed) {
  const SampledRow row = row_of(spec_with("discrete", "p + sin(u)", "v"), 0);
  EXPECT_FALSE(row.exact);
  EXPECT_LE(row.lower.get_d(), 0.90929742682568171);
  EXPECT_GE(row.upper.get_d(), 0.90929742682568169);
  EXPECT_LT(Rational(row.upper - row.lower).get_d(), 1e-14);
}

std::string message_of(const SystemSpec& spec) {
  try {
    (void)row_of(spec, 0);
  } catch (const SpecError& error) {
    return error.what();
  }
  return "no error";
}

bool is_affine(const SystemSpec& spec) {
  return AffineDynamics(spec).row(0, {0, 0, 2, 0}).has_value();
}

TEST(AffineDynamics, OtherSystemsAreLeftToTheGeneralEnclosures) {
  EXPECT_TRUE(is_affine(spec_with("discrete", "p + u^2", "v")));
  EXPECT_FALSE(is_affine(spec_with("discrete", "p*v", "v")));
  EXPECT_FALSE(is_affine(spec_with("discrete", "if(p > 3, p, v)", "v")));
  EXPECT_FALSE(is_affine(spec_with("discrete", "sin(u)*p", "v")));
  EXPECT_FALSE(is_affine(spec_with("continuous", "u - p", "v")));
}

TEST(AffineDynamics, UndefinedEquationsNameTheInput) {
  EXPECT_EQ(
      message_of(spec_with("discrete", "p + 1/(u - 2)", "v")),
      "the equation of 'p', 'p + 1/(u - 2)', is not defined or not finite at u = 2 (/dynamics/equations/p)");
}

}  // namespace
}  // namespace coordreq
