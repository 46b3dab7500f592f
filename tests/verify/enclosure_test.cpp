// The verifier's own enclosures against closed solutions.

#include <gtest/gtest.h>

#include <cmath>

#include "support/read_system.hpp"
#include "verify/flow_extremes.hpp"
#include "verify/map_extremes.hpp"
#include "verify/piece_choices.hpp"
#include "verify/post_proof.hpp"

namespace coordreq {
namespace {

struct Range {
  double lower;
  double upper;
};

SystemSpec spec_of(const std::string& x, const std::string& y, const std::string& disturbances = "",
                   const std::string& time = "continuous", const std::string& period = "0.5") {
  return read_system(
      R"json({"coordreq": 1, "name": "flow",
"states": [{"name": "x", "lower": -4, "upper": 4, "step": 1}, {"name": "y", "lower": -4, "upper": 4, "step": 1}],
"inputs": [{"name": "u", "values": [0]}], "agents": [{"name": "one", "inputs": ["u"]}],
"disturbances": [)json" +
          disturbances + R"json(], "dynamics": {"time": ")json" + time + R"json(", "period": )json" + period +
          R"json(, "equations": {"x": ")json" + x + R"json(", "y": ")json" + y +
          R"json("}}, "safe": "true"})json",
      "flow");
}

std::optional<Range> range_of(const SystemSpec& spec, Range x, Range y, Range w = {0.0, 0.0},
                              const Effort& effort = {8, 1e-9}) {
  SpanBox box(spec.slot_count());
  box[0] = span_of(exact(x.lower), exact(x.upper));
  box[1] = span_of(exact(y.lower), exact(y.upper));
  if (!spec.disturbances.empty()) box[spec.disturbance_slot(0)] = span_of(exact(w.lower), exact(w.upper));
  const Influences influences = influences_on(spec, 0);
  const auto never = [](const Arb&, const Arb&) { return false; };
  std::optional<Extremes> found;
  if (spec.dynamics.time == Time::continuous) {
    FlowExtremes flow(spec, influences, 1.0);
    if (flow.enclose(box, effort)) found = flow.extremes(0, never);
  } else {
    MapExtremes map(spec, influences, 0);
    if (map.enclose(box, effort)) found = map.extremes(0, never);
  }
  if (!found || !found->least.bound.is_finite() || !found->greatest.bound.is_finite()) return std::nullopt;
  return Range{found->least.bound.lower_rational().get_d(), found->greatest.bound.upper_rational().get_d()};
}

void expect_tight(const std::optional<Range>& found, double lower, double upper, double slack = 1e-9) {
  ASSERT_TRUE(found);
  EXPECT_LE(found->lower, lower + 1e-14);
  EXPECT_GE(found->upper, upper - 1e-14);
  EXPECT_NEAR(found->lower, lower, slack);
  EXPECT_NEAR(found->upper, upper, slack);
}

TEST(FlowExtremes, DecayIsTheHull) {
  expect_tight(range_of(spec_of("-x", "0"), {1, 2}, {0, 0}), std::exp(-0.5), 2 * std::exp(-0.5));
}

TEST(FlowExtremes, ARotatedBoxHasItsExtremesAtCorners) {
  const double c = std::cos(0.5), s = std::sin(0.5);
  expect_tight(range_of(spec_of("-y", "x"), {1, 2}, {-1, 1}), c - s, 2 * c + s);
}

/// The end of the tube of x from [1, 2] x [-1, 1], which goes round once.
Range turned_once(const std::string& dx, const std::string& disturbances) {
  const SystemSpec spec = spec_of(dx, "x", disturbances, "continuous", "6.283185307179586");
  SpanBox box(spec.slot_count());
  box[0] = span_of(1, 2);
  box[1] = span_of(-1, 1);
  if (!spec.disturbances.empty()) box[spec.disturbance_slot(0)] = span_of(exact(-0.125), exact(0.125));
  FlowExtremes flow(spec, influences_on(spec, 0), 1.0);
  EXPECT_TRUE(flow.enclose(box, {96, 1e-7}));
  const ArbSpan& end = flow.steps().back().end[0];
  return {end.lower.approximately(), end.upper.approximately()};
}

TEST(FlowExtremes, ATubeThatTurnsDoesNotGrow) {
  const Range free = turned_once("-y", "");
  EXPECT_NEAR(free.lower, 1, 1e-4);
  EXPECT_NEAR(free.upper, 2, 1e-4);
  EXPECT_LE(free.lower, 1);
  EXPECT_GE(free.upper, 2);
}

TEST(FlowExtremes, ATubeThatTurnsHoldsWhatDisturbancesDo) {
  // w = 0.125 sign(cos t) moves x by 0.125 times the integral of |cos|, which is 4.
  const Range pushed = turned_once("-y + w", R"({"name": "w", "lower": -0.125, "upper": 0.125})");
  EXPECT_LE(pushed.lower, 0.5);
  EXPECT_GE(pushed.upper, 2.5);
  EXPECT_NEAR(pushed.lower, 0.5, 0.1);
  EXPECT_NEAR(pushed.upper, 2.5, 0.1);
}

TEST(FlowExtremes, HaveFacesWhereSolutionsAreUnique) {
  const auto have = [](const std::string& dx, Range y) {
    const SystemSpec spec = spec_of(dx, "-x");
    SpanBox box(spec.slot_count());
    box[0] = span_of(exact(-0.5), exact(0.5));
    box[1] = span_of(exact(y.lower), exact(y.upper));
    FlowExtremes flow(spec, influences_on(spec, 0), 1.0);
    EXPECT_TRUE(flow.enclose(box, {8, 1e-4}));
    return flow.has_extremes_on_faces();
  };
  EXPECT_TRUE(have("abs(y)", {-0.5, 0.5}));
  EXPECT_FALSE(have("abs(y)", {0.5, 0.5}));
  EXPECT_FALSE(have("if(y > 0, 1, -1)", {-0.5, 0.5}));
}

/// Of the van der Pol oscillator: ranges that ends of sampled solutions need are proven with some faces cut
/// into pieces, and narrower ones are not.
TEST(PostProver, ProvesWhatSolutionsNeed) {
  const SystemSpec spec = read_system(R"json({"coordreq": 1, "name": "vdp",
"states": [{"name": "x", "lower": -3, "upper": 3, "step": 0.5, "outside": "saturate"},
           {"name": "y", "lower": -4, "upper": 4, "step": 0.5, "outside": "saturate"}],
"inputs": [{"name": "u", "values": [0]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "continuous", "period": 1, "equations": {"x": "y", "y": "2*(1-x^2)*y-x"}}, "safe": "true"})json",
                                      "vdp");
  const UniformGrid grid = make_grid(spec);
  const PostGroup group{.states = {0, 1}, .influences = influences_on(spec, 0)};
  SpanBox box(spec.slot_count());
  box[0] = span_of(exact(-1.25), exact(-0.75));
  box[1] = span_of(exact(1.75), exact(2.25));
  const auto verdicts = [&](IndexRange x, IndexRange y, int boxes) {
    PostProver prover(spec, grid, group);
    std::vector<OpenSubbox> subboxes = {{.cuts = {}, .claims = {0, 1}}};
    const std::vector<PostProof> proofs =
        prover.prove(box, {{0, x}, {1, y}}, subboxes, {boxes, {16, 1e-6}}, 100'000'000, 0);
    return std::pair(proofs[0].verdict, proofs[1].verdict);
  };
  EXPECT_EQ(verdicts({9, 10}, {8, 14}, 64), std::pair(PostVerdict::holds, PostVerdict::holds));
  EXPECT_EQ(verdicts({9, 10}, {8, 14}, 1).second, PostVerdict::open);
  EXPECT_NE(verdicts({9, 10}, {9, 14}, 64).second, PostVerdict::holds);
  EXPECT_NE(verdicts({9, 10}, {8, 13}, 64).second, PostVerdict::holds);
  // In rounds of more and more pieces, each of which begins where the one before has ended.
  const auto in_rounds = [&](IndexRange y) {
    PostProver prover(spec, grid, group);
    std::vector<OpenSubbox> subboxes = {{.cuts = {}, .claims = {0}}};
    PostVerdict verdict = PostVerdict::open;
    int rounds = 0;
    for (int boxes = 1; verdict == PostVerdict::open && boxes <= 64; boxes *= 4, ++rounds)
      verdict = prover.prove(box, {{1, y}}, subboxes, {boxes, {16, 1e-6}}, 100'000'000, 0)[0].verdict;
    EXPECT_EQ(subboxes.empty(), verdict != PostVerdict::open);
    return std::pair(verdict, rounds);
  };
  EXPECT_EQ(in_rounds({8, 14}).first, PostVerdict::holds);
  EXPECT_GT(in_rounds({8, 14}).second, 1);
  EXPECT_NE(in_rounds({9, 14}).first, PostVerdict::holds);
  EXPECT_NE(in_rounds({8, 13}).first, PostVerdict::holds);
}

TEST(FlowExtremes, LogisticGrowthIsTheHull) {
  const auto end_of = [](double x) { return x * std::exp(0.5) / (1 + x * (std::exp(0.5) - 1)); };
  expect_tight(range_of(spec_of("x*(1 - x)", "0"), {0.25, 0.75}, {0, 0}), end_of(0.25), end_of(0.75));
}

TEST(FlowExtremes, EveryFunctionOfTheLanguageIsExpanded) {
  // x = t for each of them: f(x) over f(x), or an identity
  for (const std::string one : {"exp(x)/exp(x)",
                                "cos(x)^2 + sin(x)^2",
                                "cosh(x)^2 - sinh(x)^2",
                                "sqrt(x + 1)/sqrt(1 + x)",
                                "log(exp(x + 1)) - x",
                                "tan(atan(x)) - x + 1",
                                "tanh(x)*cosh(x)/sinh(x)",
                                "sin(asin(x/4))*4 - x + 1",
                                "cos(acos(x/4))*4 - x + 1",
                                "abs(-x)/x",
                                "sign(x)",
                                "floor(x + 1)",
                                "mod(x + 1, 3) - x",
                                "atan2(x, x)*4/pi",
                                "tan(atan2(x, 2))*2/x",
                                "min(1, 2 + x)",
                                "max(1, x - 9)",
                                "if(x > 0, 1, 7)",
                                "(x + 1)^3/(1 + x)^3",
                                "(x + 1)^0.5/sqrt(x + 1)",
                                "pow(x + 2, -1)*(x + 2)"}) {
    SCOPED_TRACE(one);
    expect_tight(range_of(spec_of(one, "0"), {0.25, 0.25}, {0, 0}), 0.75, 0.75, 1e-8);
  }
}

TEST(FlowExtremes, WhereADerivativeEndsAtZeroNothingIsAddedBeyond) {
  const SystemSpec spec = spec_of("-0.95*w^2", "0", R"({"name": "w", "lower": -0.2, "upper": 0.2})");
  const std::optional<Range> found = range_of(spec, {1, 2}, {0, 0}, {-0.2, 0.2});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->upper, 2.0);
}

TEST(FlowExtremes, ADisturbanceWithOneSignIsTheHull) {
  const SystemSpec spec = spec_of("y + w", "-x", R"({"name": "w", "lower": -1, "upper": 1})");
  // The kernel cos(t) keeps its sign for half a second: the extreme is a constant disturbance.
  expect_tight(range_of(spec, {0, 0}, {0, 0}, {-1, 1}), -std::sin(0.5), std::sin(0.5));
}

TEST(FlowExtremes, ADisturbanceThatSwitchesIsFollowed) {
  // x(2) is the integral of cos(2 - t) w(t), whose sign changes where 2 - t = pi / 2.
  const SystemSpec spec =
      spec_of("y + w", "-x", R"({"name": "w", "lower": -1, "upper": 1})", "continuous", "2");
  const double most = 2 - std::sin(2.0);
  const std::optional<Range> found = range_of(spec, {0, 0}, {0, 0}, {-1, 1}, {64, 1e-9});
  ASSERT_TRUE(found);
  EXPECT_GE(found->upper, most);
  EXPECT_LE(found->upper, most + 0.002);  // of what is open about the step in which it switches
  EXPECT_LE(found->lower, -most);
}

TEST(FlowExtremes, AKinkIsNoObstacle) {
  // v' = w - v |v| / 4 from v = 1: v = tanh-like towards sqrt(4 w); with w = 0 it is 1 / (1 + t / 4).
  const SystemSpec spec = spec_of("w - 0.25*x*abs(x)", "0", R"({"name": "w", "lower": 0, "upper": 1})");
  const double most = 2 * std::tanh(0.25 + std::atanh(0.5));
  expect_tight(range_of(spec, {1, 1}, {0, 0}, {0, 1}), 1 / 1.125, most, 1e-6);
  expect_tight(range_of(spec, {-1, -1}, {0, 0}, {0, 0}), -1 / 1.125, -1 / 1.125, 1e-6);
  // |x| from -e to e grows as exp(t) on one side and decays on the other.
  expect_tight(range_of(spec_of("abs(x)", "0"), {-0.5, 0.5}, {0, 0}), -0.5 * std::exp(-0.5),
               0.5 * std::exp(0.5), 1e-4);
}

TEST(FlowExtremes, AJumpIsEnclosed) {
  const std::optional<Range> found =
      range_of(spec_of("-sign(x)", "0"), {-0.25, 0.25}, {0, 0}, {0, 0}, {64, 1e-6});
  ASSERT_TRUE(found);
  EXPECT_LE(found->lower, 0.0);
  EXPECT_GE(found->upper, 0.0);
  EXPECT_LE(found->upper - found->lower, 1.6);
}

TEST(FlowExtremes, ASolutionThatEscapesHasNoBound) {
  EXPECT_FALSE(range_of(spec_of("x^2", "0"), {2, 3}, {0, 0}));
}

TEST(MapExtremes, WhatIsMonotoneHasItsExtremesAtCorners) {
  expect_tight(range_of(spec_of("x^3 - x + 2*y", "0", "", "discrete"), {1, 2}, {0, 5}), 0, 16, 0.0);
  expect_tight(range_of(spec_of("if(x > 0.5, x*y, 9)", "0", "", "discrete"), {1, 2}, {1, 2}), 1, 4, 0.0);
}

TEST(MapExtremes, EnclosesWhatIsNot) {
  const std::optional<Range> found =
      range_of(spec_of("min(x, y)*x^2", "0", "", "discrete"), {-1, 1}, {-1, 1});
  ASSERT_TRUE(found);
  EXPECT_LE(found->lower, -1.0);
  EXPECT_GE(found->upper, 1.0);
}

TEST(MapExtremes, AnUndefinedMapHasNoBounds) {
  EXPECT_FALSE(range_of(spec_of("sqrt(x)", "0", "", "discrete"), {-1, 1}, {0, 0}));
  expect_tight(range_of(spec_of("sqrt(x)", "0", "", "discrete"), {0, 1}, {0, 0}), 0, 1, 1e-6);
}

/// The flow of Van der Pol's equation from a cell. @param most work
struct Spent {
  bool found = false;
  Work work = 0;
};
Spent enclosed_within(FlowExtremes& flow, Work most) {
  SpanBox box(3);
  box[0] = span_of(Rational(1), Rational(5, 4));
  box[1] = span_of(Rational(-1), Rational(-3, 4));
  const Work before = flow.work();
  flow.limit_work(most);
  const auto never = [](const Arb&, const Arb&) { return false; };
  bool found = flow.enclose(box, {16, 1e-6});
  if (found) {
    const Extremes ends = flow.extremes(0, never);
    found = ends.least.attained && ends.greatest.attained;
  }
  return {found, flow.work() - before};
}

TEST(Enclosure, StopsAtTheLimitOfItsWork) {
  const SystemSpec spec = spec_of("y", "2*(1 - x^2)*y - x");
  const Influences influences = influences_on(spec, 0);
  FlowExtremes flow(spec, influences, 1.0);
  const Spent all = enclosed_within(flow, 1'000'000'000);
  ASSERT_TRUE(all.found);
  ASSERT_FALSE(flow.is_spent());
  for (const Work most : {Work{0}, all.work / 100, all.work / 2, all.work - 1}) {
    const Spent some = enclosed_within(flow, most);
    EXPECT_TRUE(flow.is_spent()) << most;
    EXPECT_FALSE(some.found) << most;
    EXPECT_EQ(some.work, most);
  }
  const Spent again = enclosed_within(flow, all.work);
  EXPECT_TRUE(again.found);
  EXPECT_FALSE(flow.is_spent());
}

TEST(Enclosure, WhatIsRememberedCostsAsMuchAsWhatIsNot) {
  const SystemSpec spec = spec_of("y", "2*(1 - x^2)*y - x");
  const Influences influences = influences_on(spec, 0);
  FlowExtremes flow(spec, influences, 1.0);
  const Spent first = enclosed_within(flow, 1'000'000'000);
  const Spent second = enclosed_within(flow, 1'000'000'000);
  EXPECT_TRUE(second.found);
  EXPECT_EQ(first.work, second.work);
}

/// x' = 1 from 3 on, with a limit above that it may reach, that it does not, or without one.
TEST(Enclosure, AStateThatMayBeHeldAtALimitCostsMore) {
  const SystemSpec spec = spec_of("1", "0");
  const auto work = [&](const std::optional<Arb>& above) {
    SeriesField field(spec, influences_on(spec, 0), {0});
    ArbBox box(spec.slot_count());
    box[0] = Arb(3.0);
    EXPECT_TRUE(picard_tube(field, box, Arb(0.5), {StopLimits{.below = {}, .above = above}}));
    return field.work();
  };
  const Work free = work(std::nullopt);
  EXPECT_EQ(work(Arb(100.0)), free);
  EXPECT_GE(work(Arb(3.25)), free + 32);
}

}  // namespace
}  // namespace coordreq
