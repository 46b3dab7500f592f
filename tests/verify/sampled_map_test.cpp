#include "verify/sampled_map.hpp"

#include <gtest/gtest.h>

#include "support/read_system.hpp"

namespace coordreq {
namespace {

SystemSpec chain(const std::string& equations, const std::string& disturbances = "") {
  return read_system(R"json({"coordreq": 1, "name": "chain",
"states": [{"name": "p", "lower": 0, "upper": 4, "step": 1}, {"name": "v", "lower": 0, "upper": 4, "step": 1},
           {"name": "a", "lower": 0, "upper": 4, "step": 1}],
"inputs": [{"name": "u", "values": [2]}], "agents": [{"name": "one", "inputs": ["u"]}],
"disturbances": [)json" + disturbances +
                         R"json(], "dynamics": {"time": "continuous", "period": 0.5, "equations": {)json" +
                         equations + R"json(}}, "safe": "true"})json",
                     "chain");
}

SampledMap solved(const SystemSpec& spec, std::size_t state) {
  std::vector<Rational> slots(spec.slot_count());
  slots[spec.input_slot(0)] = 2;
  return sampled_map(spec, influences_on(spec, state), state, slots).value();
}

TEST(SampledMap, AChainOfIntegratorsIsAPolynomialInThePeriod) {
  const SystemSpec spec = chain(R"("p": "v", "v": "a", "a": "u")");
  const SampledMap p = solved(spec, 0);
  // p + tau v + tau^2/2 a + tau^3/6 u with tau = 1/2, u = 2
  EXPECT_EQ(p.coefficient, (std::vector<Rational>{1, Rational(1) / 2, Rational(1) / 8}));
  EXPECT_EQ(p.lower, Rational(1) / 24);
  EXPECT_EQ(p.upper, p.lower);
  EXPECT_TRUE(p.exact);
  EXPECT_EQ(influences_on(spec, 1).moving, (std::vector<std::size_t>{1, 2}));
}

TEST(SampledMap, ADisturbanceAddsWhatItCanAddUp) {
  const SystemSpec spec =
      chain(R"("p": "v", "v": "w", "a": "0")", R"({"name": "w", "lower": -1, "upper": 3})");
  const SampledMap p = solved(spec, 0);
  EXPECT_EQ(p.lower, -Rational(1) / 8);
  EXPECT_EQ(p.upper, Rational(3) / 8);
}

/// w pushes p down by w/4 at once and up by what it adds to v: a steady w adds up to nothing, one that
/// changes sides half-way does not.
TEST(SampledMap, ADisturbanceMayChangeSidesOnTheWay) {
  const SystemSpec spec =
      chain(R"("p": "v - w/4", "v": "w", "a": "0")", R"({"name": "w", "lower": -1, "upper": 3})");
  const SampledMap p = solved(spec, 0);
  EXPECT_EQ(p.lower, -Rational(1) / 8);
  EXPECT_EQ(p.upper, Rational(1) / 8);
}

TEST(SampledMap, OfAMapTakesTheDisturbanceFromItsWorseEnd) {
  SystemSpec spec =
      chain(R"("p": "v - 2*w", "v": "v", "a": "0")", R"({"name": "w", "lower": -1, "upper": 3})");
  spec.dynamics.time = Time::discrete;
  const SampledMap p = solved(spec, 0);
  EXPECT_EQ(p.lower, -6);
  EXPECT_EQ(p.upper, 2);
}

TEST(SampledMap, AMatrixThatIsNotNilpotentIsNotSolved) {
  const SystemSpec spec = chain(R"("p": "v", "v": "-p", "a": "0")");
  EXPECT_FALSE(sampled_map(spec, influences_on(spec, 0), 0, std::vector<Rational>(spec.slot_count())));
}

TimedMap timed(const SystemSpec& spec, std::size_t state) {
  std::vector<Rational> slots(spec.slot_count());
  slots[spec.input_slot(0)] = 2;
  return timed_map(spec, influences_on(spec, state), state, slots).value();
}

TEST(TimedMap, AtTheEndOfThePeriodItIsTheSampledMap) {
  const Rational tau = Rational(1) / 2;
  for (const std::string v : {"a", "a + w", "w - 3*a"}) {
    const SystemSpec spec =
        chain(R"("p": "v", "v": ")" + v + R"(", "a": "u")", R"({"name": "w", "lower": -1, "upper": 3})");
    const SampledMap map = solved(spec, 0);
    const TimedMap p = timed(spec, 0);
    for (std::size_t j = 0; j < map.coefficient.size(); ++j)
      EXPECT_EQ(p.coefficient[j].at(tau), map.coefficient[j]) << v << j;
    EXPECT_EQ(p.lower.at(tau), map.lower) << v;
    EXPECT_EQ(p.upper.at(tau), map.upper) << v;
    EXPECT_TRUE(p.exact) << v;
    EXPECT_EQ(p.attained, (std::vector{p.lower, p.upper})) << v;
  }
}

TEST(TimedMap, AKernelThatChangesItsSignIsBounded) {
  // p(t) - p(0) - v(0) t = integral of (1 - 4 (t - s)) w(s), with w in [-1, 1]: the kernel is 1 - 4 s
  const SystemSpec spec =
      chain(R"("p": "v + w", "v": "-4*w", "a": "0")", R"({"name": "w", "lower": -1, "upper": 1})");
  const TimedMap p = timed(spec, 0);
  EXPECT_FALSE(p.exact);
  const Rational tau = Rational(1) / 2;
  EXPECT_GE(p.upper.at(tau), solved(spec, 0).upper);
  EXPECT_EQ(p.upper.at(tau), 1);  // integral of 1 + 4 s
  ASSERT_EQ(p.attained.size(), 2U);
  EXPECT_EQ(p.attained[1].at(Rational(1) / 4), Rational(1) / 8);
}

TEST(SampledMap, ConstantsThatAreNoRationalNumbersAreNotExact) {
  const SystemSpec spec = chain(R"("p": "v", "v": "sin(1) + a", "a": "0")");
  EXPECT_FALSE(sampled_map(spec, influences_on(spec, 0), 0, std::vector<Rational>(spec.slot_count())));
}

}  // namespace
}  // namespace coordreq
