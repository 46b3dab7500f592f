#include "reach/point_dynamics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/error.hpp"
#include "support/read_system.hpp"

namespace coordreq {
namespace {

/// Two states p and v, an input u, a disturbance w.
SystemSpec spec_of(const std::string& time, const std::string& p, const std::string& v,
                   const std::string& edges_of_v = "\"unsafe\"", const std::string& more_of_p = "") {
  return read_system(R"({"coordreq": 1, "name": "t",
"states": [{"name": "p", "lower": 0, "upper": 10, "step": 1)" +
                         more_of_p + R"(},
           {"name": "v", "lower": 0, "upper": 3, "step": 0.5, "outside": )" +
                         edges_of_v + R"(}],
"inputs": [{"name": "u", "values": [-1, 0, 2]}], "disturbances": [{"name": "w", "lower": -1, "upper": 1}],
"agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": ")" +
                         time + R"(", "period": 0.5, "equations": {"p": ")" + p + R"(", "v": ")" + v +
                         R"("}}, "safe": "true"})",
                     "test");
}

/// Next p and v from p, v under u, w.
std::vector<std::optional<Rational>> next(const SystemSpec& spec, const Rational& p, const Rational& v,
                                          const Rational& u, const Rational& w = 0) {
  PointDynamics dynamics(spec);
  const std::vector<Rational> slots{p, v, u, w};
  return {dynamics.next(0, slots), dynamics.next(1, slots)};
}

double as_double(const std::optional<Rational>& value) {
  return value ? nearest_double(*value) : std::nan("");
}

TEST(PointDynamics, IntegratorChainsAreExact) {
  const auto found = next(spec_of("continuous", "v", "u + w"), Rational(1) / 3, 1, 2, Rational(1) / 7);
  const Rational a = 2 + Rational(1) / 7;
  EXPECT_EQ(found[0], Rational(Rational(1) / 3 + Rational(1) / 2 + a / 8));
  EXPECT_EQ(found[1], Rational(1 + a / 2));
}

TEST(PointDynamics, AffineMapsAreExact) {
  const auto found = next(spec_of("discrete", "0.3*p - v + w", "u * v"), Rational(1) / 3, 2, 2, -1);
  EXPECT_EQ(found[0], Rational(Rational(1) / 10 - 3));
  EXPECT_EQ(found[1], Rational(4));
}

TEST(PointDynamics, OtherMapsAreEvaluatedInDoubles) {
  const auto found = next(spec_of("discrete", "sin(p)", "v^2 + u"), 2, Rational(1) / 2, 2);
  EXPECT_EQ(as_double(found[0]), std::sin(2.0));
  EXPECT_EQ(as_double(found[1]), 2.25);
}

TEST(PointDynamics, DiscreteStatesStayOnTheirLattice) {
  const SystemSpec spec =
      spec_of("discrete", "if(cos(v) < 2, p + 1, p)", "v", "\"unsafe\"", R"(, "discrete": true)");
  EXPECT_EQ(next(spec, 4, Rational(1) / 3, 0)[0], Rational(5));
}

TEST(PointDynamics, LinearDecayIsAccurate) {
  const auto found = next(spec_of("continuous", "-2*p", "u"), 3, 1, 0);
  EXPECT_NEAR(as_double(found[0]), 3 * std::exp(-1.0), 1e-11);
}

TEST(PointDynamics, ThePapersVehicleIsAccurate) {
  // v' = 2 - 0.2 v^2 from rest: v = sqrt(10) tanh(sqrt(0.4) t), p' = v.
  const auto found = next(spec_of("continuous", "v", "u - 0.2*v^2"), 1, 0, 2);
  EXPECT_NEAR(as_double(found[1]), std::sqrt(10.0) * std::tanh(std::sqrt(0.4) / 2), 1e-11);
  EXPECT_NEAR(as_double(found[0]), 1 + 5 * std::log(std::cosh(std::sqrt(0.4) / 2)), 1e-11);
}

TEST(PointDynamics, DisturbancesAreConstantInAPeriod) {
  const auto found = next(spec_of("continuous", "w*p", "u"), 3, 1, 0, Rational(1) / 2);
  EXPECT_NEAR(as_double(found[0]), 3 * std::exp(0.25), 1e-11);
}

TEST(PointDynamics, StopHoldsAVehicleThatHasBraked) {
  // From v = 0.25 with u = -1 it stands after 0.25, having gone 1/32.
  const auto found = next(spec_of("continuous", "v", "u", R"({"below": "stop"})"), 1, Rational(1) / 4, -1);
  EXPECT_EQ(found[1], Rational(0));
  EXPECT_NEAR(as_double(found[0]), 1.03125, 1e-11);
}

TEST(PointDynamics, StopLetsGoWhenTheDerivativeTurns) {
  // v' = p - 1.2 is outward until p' = 1 has brought p from 1 to 1.2, then v = (t - 0.2)^2 / 2.
  const auto found = next(spec_of("continuous", "1", "p - 1.2", R"({"below": "stop"})"), 1, 0, 0);
  EXPECT_NEAR(as_double(found[1]), 0.045, 1e-10);
}

TEST(PointDynamics, StopHoldsAtTheUpperLimitToo) {
  const auto found = next(spec_of("continuous", "v", "u", R"({"above": "stop"})"), 1, Rational(11) / 4, 2);
  EXPECT_EQ(found[1], Rational(3));
  EXPECT_NEAR(as_double(found[0]), 1 + 0.125 * 2.875 + 0.375 * 3, 1e-11);
}

TEST(PointDynamics, AJumpOfTheDerivativeIsCrossed) {
  // p' = 1 up to p = 1.25, then 3.
  const auto found = next(spec_of("continuous", "if(p < 1.25, 1, 3)", "u"), 1, 1, 0);
  EXPECT_NEAR(as_double(found[0]), 2.0, 1e-9);
}

TEST(PointDynamics, SlidingAlongAJumpEnds) {
  const auto found = next(spec_of("continuous", "-sign(p - 1)", "u"), Rational(5) / 4, 1, 0);
  EXPECT_NEAR(as_double(found[0]), 1.0, 1e-3);
}

TEST(PointDynamics, AnEscapeToInfinityHasNoNextState) {
  EXPECT_EQ(next(spec_of("continuous", "p^2", "u"), 4, 1, 0)[0], std::nullopt);
  EXPECT_EQ(next(spec_of("continuous", "sqrt(2 - p)", "u"), 3, 1, 0)[0], std::nullopt);
}

TEST(PointDynamics, RowsThatAreKeptAreThoseOfTheirInputs) {
  const SystemSpec spec = spec_of("discrete", "0.3*p - v + w", "u * v");
  PointDynamics dynamics(spec);
  for (int k = 0; k < 3; ++k) {
    for (const int u : {-1, 0, 2}) {
      EXPECT_EQ(dynamics.next(1, {1, 3, u, 0}), Rational(3 * u));
      EXPECT_EQ(dynamics.next(0, {10, 3, u, k}), Rational(k));
    }
  }
}

TEST(PointDynamics, AnEstimateIsNoFartherOffThanItSays) {
  const SystemSpec spec = spec_of("continuous", "v", "u + w");
  PointDynamics dynamics(spec);
  for (int k = 1; k < 200; ++k) {
    const std::vector<Rational> slots{Rational(k) / 7, Rational(-1000000) / (3 * k), 2,
                                      Rational(1) / (9 * k)};
    std::vector<double> doubles;
    for (const Rational& value : slots) doubles.push_back(nearest_double(value));
    const auto found = dynamics.estimate(0, slots, doubles);
    ASSERT_TRUE(found);
    const Rational off = exact(found->value) - dynamics.next(0, slots).value();
    EXPECT_LE(abs(off), exact(found->error));
    EXPECT_LT(found->error, 1e-9);
  }
}

TEST(PointDynamics, ThereIsNoEstimateWhereDoublesLosePrecision) {
  const SystemSpec spec = spec_of("discrete", "p + v", "v");
  PointDynamics dynamics(spec);
  mpz_class large;
  mpz_ui_pow_ui(large.get_mpz_t(), 2, 1060);
  const std::vector<Rational> slots{1, Rational(1) / large, 0, 0};
  EXPECT_FALSE(dynamics.estimate(0, slots, {1.0, nearest_double(slots[1]), 0.0, 0.0}));
  EXPECT_FALSE(PointDynamics(spec_of("discrete", "sin(p)", "v")).estimate(0, slots, {1.0, 0.5, 0.0, 0.0}));
}

TEST(PointDynamics, ExactStatesMayNotGrowForEver) {
  const SystemSpec spec = spec_of("discrete", "p / 3", "v");
  PointDynamics dynamics(spec);
  mpz_class large;
  mpz_ui_pow_ui(large.get_mpz_t(), 2, PointDynamics::kMostBits);
  const std::vector<Rational> slots{Rational(1) / Rational(large), 0, 0, 0};
  EXPECT_THROW(static_cast<void>(dynamics.next(0, slots)), LimitError);
}

}  // namespace
}  // namespace coordreq
