#include "reach/point_flow.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <string>

#include "expression/evaluate.hpp"
#include "support/read_system.hpp"

namespace coordreq {
namespace {

/// States h, described by `h`, and p; the period is 1/2.
SystemSpec flow_spec(const std::string& h, const std::string& rate_of_h, const std::string& rate_of_p) {
  return read_system(R"({"coordreq": 1, "name": "t", "states": [{"name": "h", )" + h +
                         R"(}, {"name": "p", "lower": -100, "upper": 100, "step": 1}],
"inputs": [{"name": "u", "values": [0]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "continuous", "period": 0.5, "equations": {"h": ")" +
                         rate_of_h + R"(", "p": ")" + rate_of_p + R"("}}, "safe": "true"})",
                     "test");
}

const std::string kRing = R"("lower": 0, "upper": 1, "count": 8, "outside": "periodic")";
const std::string kStopped = R"("lower": 0, "upper": 1, "step": 0.125, "outside": "stop")";
const std::string kOpen = R"("lower": -100, "upper": 100, "step": 0.125)";

std::vector<double> after_period(const SystemSpec& spec, double h, double p = 0.0) {
  const std::vector<std::int32_t> moving{0, 1};
  return PointFlow(spec, moving).after_period(std::vector<double>{h, p, 0.0}).value();
}

TEST(PointFlow, WhatTurnsIsSeenInOnePeriodOnly) {
  // h reaches 1 after 5/19 and goes on from 0.
  const double before = 5.0 / 19.0;
  const double after = 0.5 - before;
  const double p = 0.5 * before + 0.95 * before * before + 0.95 * after * after;
  const std::vector<double> end = after_period(flow_spec(kRing, "1.9", "h"), 0.5);
  EXPECT_NEAR(p, 0.25066, 1e-5);
  EXPECT_NEAR(end[1], p, 1e-12);
  EXPECT_NEAR(end[0], 1.45, 1e-12);  // not wrapped
}

TEST(PointFlow, TheSeamIsPassedBothWaysAndMoreThanOnce) {
  // Ten turns and a quarter: each adds the mean of h.
  EXPECT_NEAR(after_period(flow_spec(kRing, "20.5", "h"), 0)[1], (10 * 0.5 + 0.03125) / 20.5, 1e-11);
  EXPECT_NEAR(after_period(flow_spec(kRing, "-20", "h"), 0.5)[1], 0.25, 1e-11);
  EXPECT_NEAR(after_period(flow_spec(kRing, "-20", "h"), 0.5)[0], -9.5, 1e-11);
}

TEST(PointFlow, AStateThatDrivesItselfAcrossTheSeam) {
  // h' = 1 + h: from 1/2 to 1 in log(4/3), then from 0: exp(t) - 1.
  const double rest = 0.5 - std::log(4.0 / 3.0);
  EXPECT_NEAR(after_period(flow_spec(kRing, "1 + h", "0"), 0.5)[0], 1 + std::expm1(rest), 1e-12);
}

TEST(PointFlow, ASeamThatNobodySeesCostsNothing) {
  EXPECT_NEAR(after_period(flow_spec(kRing, "1e6 + p", "2"), 0.5, 1.0)[0], 0.5 + 5e5 + 0.5 + 0.25, 1e-6);
}

TEST(PointFlow, WhatDecaysFastIsFollowedInFewSteps) {
  for (const std::string rate : {"1e3", "1e6", "1e9"}) {
    // h is next to sin(p), behind it by cos(p)/rate; p = 2t.
    const std::vector<double> end = after_period(flow_spec(kOpen, "-" + rate + "*(h - sin(p))", "2"), 7.0);
    EXPECT_NEAR(end[1], 1.0, 1e-12);
    EXPECT_NEAR(end[0], std::sin(1.0) - 2 * std::cos(1.0) / std::stod(rate), 5e-6) << rate;
  }
}

TEST(PointFlow, WhatOscillatesFastIsNotStiff) {
  const std::vector<double> end = after_period(flow_spec(kOpen, "500*p", "-500*h"), 1.0);
  EXPECT_NEAR(end[0], std::cos(250.0), 1e-8);
  EXPECT_NEAR(end[1], -std::sin(250.0), 1e-8);
}

TEST(PointFlow, KinksAreCrossed) {
  // h = 2t - 1/2 passes 0 at 1/4.
  EXPECT_NEAR(after_period(flow_spec(kOpen, "2", "abs(h)"), -0.5)[1], 0.125, 1e-14);
  EXPECT_NEAR(after_period(flow_spec(kOpen, "2", "max(h, 0)"), -0.5)[1], 0.0625, 1e-14);
  EXPECT_NEAR(after_period(flow_spec(kOpen, "2", "min(h, 0)"), -0.5)[1], -0.0625, 1e-14);
  EXPECT_NEAR(after_period(flow_spec(kOpen, "2", "sign(h)"), -0.5)[1], 0.0, 1e-14);
  EXPECT_NEAR(after_period(flow_spec(kOpen, "2", "if(h < 0, 1, 3)"), -0.5)[1], 1.0, 1e-13);
}

TEST(PointFlow, ABranchMayBeUndefinedWhereItIsNotTaken) {
  // h = t - 1/4: the integral of sqrt(h) from 0 to 1/4 is 1/12.
  EXPECT_NEAR(after_period(flow_spec(kOpen, "1", "if(h > 0, sqrt(h), 0)"), -0.25)[1], 1.0 / 12, 1e-9);
  EXPECT_NEAR(after_period(flow_spec(kOpen, "-1", "if(h > 0, 1/h^2, 0)"), 0.75)[1], 4 - 4.0 / 3, 1e-9);
}

TEST(PointFlow, TwoEventsAtOnce) {
  // h reaches the seam when p reaches 1, where its own rate doubles.
  const std::vector<double> end = after_period(flow_spec(kRing, "2", "if(p < 1, 2, 4)"), 0.5, 0.5);
  EXPECT_NEAR(end[0], 1.5, 1e-12);
  EXPECT_NEAR(end[1], 2.0, 1e-12);
}

TEST(PointFlow, WhatSlidesStays) {
  EXPECT_NEAR(after_period(flow_spec(kOpen, "-sign(h) + 0.5", "0"), 0.1)[0], 0.0, 1e-3);
  EXPECT_NEAR(after_period(flow_spec(kOpen, "if(h < 0, 1, -3)", "h"), 0.75)[1], 0.09375, 1e-3);
}

TEST(PointFlow, WhatSlidesStaysWithinAPartOfAStepHoweverFastItIs) {
  const double substep = 0.125 / 64;
  EXPECT_NEAR(after_period(flow_spec(kOpen, "if(h > 0, -1e9, 1)", "0"), 0.1)[0], 0.0, 1.01 * substep);
  EXPECT_NEAR(after_period(flow_spec(kOpen, "if(h > 0, -1, 1e9)", "0"), 0.1)[0], 0.0, 1.01 * substep);
  EXPECT_NEAR(after_period(flow_spec(kOpen, "-100*sign(h)", "0"), 0.1)[0], 0.0, 1.01 * substep);
}

TEST(PointFlow, WhatIsFastOnBothSidesOfAJumpIsNotFollowed) {
  const std::vector<std::int32_t> moving{0};
  const SystemSpec spec = flow_spec(kOpen, "-1e9*sign(h)", "0");
  EXPECT_EQ(PointFlow(spec, moving).after_period(std::vector<double>{0.1, 0.0, 0.0}), std::nullopt);
}

TEST(PointFlow, WhatIsHeldIsLetGo) {
  // h = 1/4 + t up to its limit 1 - which it leaves when p = 3/4 - 2t has become negative.
  const std::vector<double> end = after_period(flow_spec(kStopped, "if(p > 0, 4, -2)", "-2"), 0.5, 0.75);
  EXPECT_NEAR(end[0], 1.0 - 2 * 0.125, 1e-12);
}

/// h' is constant and p' = F(h) + 1/3 with F linear between some breaks, followed exactly.
class ExactFlow {
 public:
  ExactFlow(const SystemSpec& spec, std::vector<Rational> breaks)
      : spec_(spec), breaks_(std::move(breaks)), rate_(spec.dynamics.equations[1]) {}

  void run(Rational rate) {
    const StateSpec& state = spec_.states[0];
    Rational left = spec_.dynamics.period;
    while (left > 0) {
      if (state.above == Outside::stop && ((rate > 0 && h == 1) || (rate < 0 && h == 0))) rate = 0;
      if (state.above == Outside::periodic && rate > 0 && h == 1) h = 0;
      if (state.above == Outside::periodic && rate < 0 && h == 0) h = 1;
      Rational time = left;
      for (const Rational& position : breaks_) {
        const Rational reached = rate == 0 ? left : Rational((position - h) / rate);
        if (reached > 0) time = std::min(time, reached);
      }
      p += time * rate_at(h + rate * time / 2);
      h += rate * time;
      left -= time;
    }
  }

  Rational h;
  Rational p;

 private:
  Rational rate_at(const Rational& middle) {
    std::vector<RationalInterval> slots(spec_.slot_count());
    slots[0] = {.lower = middle, .upper = middle};
    return rate_.number(slots).lower;
  }

  const SystemSpec& spec_;
  std::vector<Rational> breaks_;
  Evaluator<RationalInterval> rate_;
};

TEST(PointFlow, PiecewiseLinearMotionIsExact) {
  EXPECT_TRUE(rc::check([] {
    const int k = *rc::gen::inRange(0, 17);
    const std::string position = std::to_string(k) + "/16";
    const std::vector<std::string> pieces{"h",
                                          "abs(h - " + position + ")",
                                          "sign(h - " + position + ")",
                                          "floor(2*min(max(h, 0), 1) - 2*" + position + ")",
                                          "min(h, " + position + ")",
                                          "max(" + position + ", 1 - h)",
                                          "if(h < " + position + ", 1 + h, -2)",
                                          "abs(abs(h - 1/2) - " + position + ")",
                                          "if(h >= " + position + " and not h > 3/4, h, sign(h - 1/4))"};
    const std::string first = *rc::gen::elementOf(pieces);
    const std::string second = *rc::gen::elementOf(pieces);
    const std::string kind = *rc::gen::elementOf(std::vector<std::string>{kRing, kStopped, kOpen});
    const int rate = *rc::gen::inRange(-60, 61);
    const SystemSpec spec =
        flow_spec(kind, std::to_string(rate) + "/7", first + " - 2*(" + second + ") + 1/3");
    const Rational at(k, 16);
    ExactFlow exact(spec, {0, 1, Rational(1, 4), Rational(1, 2), Rational(3, 4), at, 1 - at,
                           Rational(1, 2) - at, Rational(1, 2) + at, at - Rational(1, 2)});
    exact.h = Rational(*rc::gen::inRange(0, kind == kRing ? 96 : 97)) / 96;
    const double start = nearest_double(exact.h);
    exact.run(Rational(rate) / 7);
    const std::vector<double> end = after_period(spec, start);
    const double turned = end[0] - nearest_double(exact.h);
    RC_ASSERT(std::fabs(kind == kRing ? std::remainder(turned, 1.0) : turned) < 1e-12);
    RC_ASSERT(std::fabs(end[1] - nearest_double(exact.p)) < 1e-11);
  }));
}

}  // namespace
}  // namespace coordreq
