#include "cell/closed_loop.hpp"
#include "answers/step_codes.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "loop_fixture.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using test::line_spec;
using test::LoopFixture;

std::vector<std::int32_t> countdowns(const RunTrace& trace) {
  std::vector<std::int32_t> result;
  for (const RunTrace::Sample& sample : trace.samples) result.push_back(sample.countdown);
  return result;
}

/// "." without coordination, "C" with.
std::string coordination(const RunTrace& trace) {
  std::string text;
  for (const RunTrace::Step& step : trace.steps) text += step.coordinated ? 'C' : '.';
  return text;
}

std::vector<double> positions(const RunTrace& trace) {
  std::vector<double> result;
  for (const RunTrace::Sample& sample : trace.samples) result.push_back(sample.state.front());
  return result;
}

/// x moves by 1 whatever the agents do, past cells with these delays.
const std::vector<std::int32_t> kRoad = {3, 9, 9, 1, 1, 2, 0, 5, kUnbounded, 4};

RunTrace ride(std::int64_t connection_delay, int start, std::int64_t steps) {
  const LoopFixture loop(line_spec(10, "x + 1"), kRoad, connection_delay);
  return loop.run({start}, {.steps = steps});
}

TEST(ClosedLoop, CountsDownAndResetsAfterCoordination) {
  const RunTrace trace = ride(0, 0, 9);
  //  3 alone, at cell 3 coordinated; into 4 with delay 1; ... 6 has delay 0: coordinated again
  EXPECT_EQ(countdowns(trace), (std::vector<std::int32_t>{3, 2, 1, 0, 1, 0, 0, 5, 4, 3}));
  EXPECT_EQ(coordination(trace), "...C.CC..");
  EXPECT_EQ(trace.outcome, Outcome::completed);
  EXPECT_EQ(trace.coordinated_steps(), 3);
  EXPECT_EQ(trace.longest_silence(), 3);
}

TEST(ClosedLoop, TheCountdownDoesNotLookAtTheDelayOnTheWay) {
  const RunTrace trace = ride(0, 0, 3);
  EXPECT_EQ(trace.samples[1].delay, 9);
  EXPECT_EQ(trace.samples[1].countdown, 2);
}

TEST(ClosedLoop, TheConnectionStaysWhereItWouldComeTooLate) {
  const RunTrace trace = ride(2, 0, 9);
  // coordinated at 3; 4 has delay 1 < 2, so the connection stays; 5 has delay 2, dropped; 8 never needs one
  EXPECT_EQ(countdowns(trace), (std::vector<std::int32_t>{3, 2, 1, 0, 0, 2, 1, 0, kUnbounded, kUnbounded}));
  EXPECT_EQ(coordination(trace), "...CC..C.");
}

TEST(ClosedLoop, AStartThatCannotWaitIsConnected) {
  EXPECT_EQ(coordination(ride(2, 3, 3)), "CC.");
  EXPECT_EQ(coordination(ride(1, 3, 3)), ".C.");
  EXPECT_EQ(coordination(ride(6, 0, 8)), "C.......");
}

TEST(ClosedLoop, UnboundedCellsNeverCoordinate) {
  const RunTrace trace = ride(7, 8, 1);
  EXPECT_EQ(countdowns(trace), (std::vector<std::int32_t>{kUnbounded, kUnbounded}));
  EXPECT_EQ(coordination(trace), ".");
}

TEST(ClosedLoop, LeavingKEndsTheRunWithItsTrace) {
  // Cell 2 is made to look as if it were in K although its only way on is cell 3, which is not.
  const LoopFixture loop(line_spec(6, "x + 1", "\"unsafe\"", R"({"name": "a", "inputs": ["u", "v"]})",
                                   R"(, "controller": {"synthesis": "given"})"),
                         {5, 5, 5, -1, -1, -1});
  const RunTrace trace = loop.run({0}, {.steps = 9});
  EXPECT_EQ(trace.outcome, Outcome::left_invariant);
  EXPECT_EQ(positions(trace), (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(trace.samples.back().delay, -1);
  EXPECT_EQ(trace.steps.size(), 3U);
}

TEST(ClosedLoop, WhatCannotBeFollowedSaysNothingOfTheAnalysis) {
  // x(t) = 1/(1/3 - t) has no value at a third of the period.
  std::string spec = line_spec(4, "x^2", "\"unsafe\"", R"({"name": "a", "inputs": ["u", "v"]})",
                               R"(, "controller": {"synthesis": "given"})");
  spec.replace(spec.find("discrete"), 8, "continuous");
  const RunTrace trace = LoopFixture(spec, {5, 5, 5, 5}).run({3}, {.steps = 9});
  EXPECT_EQ(trace.outcome, Outcome::not_followed);
  EXPECT_FALSE(is_violation(trace.outcome));
  EXPECT_TRUE(trace.steps.empty());
  EXPECT_NEAR(trace.followed, 1.0 / 3, 1e-3);
}

TEST(ClosedLoop, WithoutAnAdmissibleActionTheRunEnds) {
  const LoopFixture loop(line_spec(6, "x + 1"), {5, 5, 5, -1, -1, -1});
  const RunTrace trace = loop.run({0}, {.steps = 9});
  EXPECT_EQ(trace.outcome, Outcome::no_action);
  EXPECT_EQ(positions(trace), (std::vector<double>{0, 1, 2}));
  EXPECT_TRUE(is_violation(trace.outcome));
}

TEST(ClosedLoop, ASafeSideEndsWell) {
  const LoopFixture loop(line_spec(4, "x + 1", R"({"above": "safe"})"), {1, 1, 1, 1});
  const RunTrace trace = loop.run({Rational(5) / 4}, {.steps = 9});
  EXPECT_EQ(trace.outcome, Outcome::left_safely);
  EXPECT_FALSE(is_violation(trace.outcome));
  EXPECT_EQ(positions(trace), (std::vector<double>{1.25, 2.25, 3.25, 4.25}));
  EXPECT_EQ(trace.samples.back().delay, kUnbounded);
  EXPECT_EQ(trace.smallest_margin(), 8.5 - 3.25);
}

TEST(ClosedLoop, AnUnsafeSideIsNone) {
  const LoopFixture loop(line_spec(3, "x + 1", "\"unsafe\"", R"({"name": "a", "inputs": ["u", "v"]})",
                                   R"(, "controller": {"synthesis": "given"})"),
                         {1, 1, 1});
  const RunTrace trace = loop.run({2}, {.steps = 9});
  EXPECT_EQ(trace.outcome, Outcome::left_invariant);
  EXPECT_EQ(trace.samples.back().delay, kOutsideSafe);
}

TEST(ClosedLoop, SaturateResetsAtTheSample) {
  const LoopFixture loop(line_spec(3, "x + 0.75", R"({"above": "saturate"})"), {1, 1, 1});
  EXPECT_EQ(positions(loop.run({1}, {.steps = 3})), (std::vector<double>{1, 1.75, 2, 2}));
}

TEST(ClosedLoop, FacesBelongToTheUpperCell) {
  // Exact: ten times 1/10 is 1, and 1/2 lies in the cell of 1.
  const LoopFixture loop(line_spec(3, "x + 0.1"), {7, 8, 9});
  const RunTrace trace = loop.run({0}, {.steps = 10});
  EXPECT_EQ(trace.samples[4].delay, 7);
  EXPECT_EQ(trace.samples[5].delay, 8);
  EXPECT_EQ(trace.samples[10].state.front(), 1.0);
}

/// x' = x + w over a wide line, with a measurement error of 1/4.
RunTrace drift(const LoopOptions& options, std::uint64_t run = 0) {
  const std::string spec = R"({"coordreq": 1, "name": "drift",
"states": [{"name": "x", "lower": -1000, "upper": 1000, "step": 1, "measurement_error": 0.25}],
"inputs": [{"name": "u", "values": [0]}], "disturbances": [{"name": "w", "lower": -0.5, "upper": 1}],
"agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "discrete", "period": 1, "equations": {"x": "x + w"}}, "safe": "true"})";
  const LoopFixture loop(spec, std::vector<std::int32_t>(2001, 9));
  return loop.run({Rational(0)}, options, run);
}

TEST(ClosedLoop, ExtremesAreBothEndsAndNothingElse) {
  const RunTrace trace = drift({.steps = 100, .disturbance = Disturbance::extremes});
  int upper = 0;
  int late = 0;
  for (std::size_t k = 0; k < 100; ++k) {
    const double w = trace.steps[k].disturbance.front();
    EXPECT_TRUE(w == -0.5 || w == 1.0);
    EXPECT_EQ(trace.samples[k + 1].state.front(), trace.samples[k].state.front() + w);
    upper += w == 1.0 ? 1 : 0;
    const double error = trace.samples[k].measured.front() - trace.samples[k].state.front();
    EXPECT_TRUE(error == -0.25 || error == 0.25);
    late += error < 0 ? 1 : 0;
  }
  EXPECT_NEAR(upper, 50, 25);
  EXPECT_NEAR(late, 50, 25);
}

TEST(ClosedLoop, RandomDisturbancesFillTheirRanges) {
  const RunTrace trace = drift({.steps = 400});
  double low = 1, high = -1, least = 1, most = -1;
  for (std::size_t k = 0; k < 400; ++k) {
    low = std::min(low, trace.steps[k].disturbance.front());
    high = std::max(high, trace.steps[k].disturbance.front());
    const double error = trace.samples[k].measured.front() - trace.samples[k].state.front();
    least = std::min(least, error);
    most = std::max(most, error);
  }
  EXPECT_TRUE(low >= -0.5 && low < -0.45 && high > 0.95 && high <= 1) << low << " " << high;
  EXPECT_TRUE(least >= -0.25 && least < -0.23 && most > 0.23 && most <= 0.25) << least << " " << most;
}

TEST(ClosedLoop, ConstantDisturbancesAreWhatTheyAreAndNothingIsMeasuredWrongly) {
  const RunTrace trace =
      drift({.steps = 5, .disturbance = Disturbance::constant, .constant_disturbance = {Rational(1) / 4}});
  EXPECT_EQ(positions(trace), (std::vector<double>{0, 0.25, 0.5, 0.75, 1, 1.25}));
  for (const RunTrace::Sample& sample : trace.samples) EXPECT_EQ(sample.measured, sample.state);
}

TEST(ClosedLoop, TheStartIsMeasuredAndTheTrueStateIsOff) {
  const RunTrace trace = drift({.steps = 1});
  EXPECT_EQ(trace.samples.front().measured.front(), 0.0);
  EXPECT_NE(trace.samples.front().state.front(), 0.0);
}

TEST(ClosedLoop, AStartThatIsMeasuredAtAStopIsNotBeyondIt) {
  const std::string spec = R"({"coordreq": 1, "name": "stop",
"states": [{"name": "x", "lower": 0, "upper": 4, "step": 1, "measurement_error": 0.25, "outside": "stop"}],
"inputs": [{"name": "u", "values": [0]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "continuous", "period": 1, "equations": {"x": "u"}}, "safe": "true"})";
  const LoopFixture loop(spec, std::vector<std::int32_t>(5, 9));
  int inside = 0;
  for (std::uint64_t run = 0; run < 20; ++run) {
    const double bottom = loop.run({Rational(0)}, {.steps = 0}, run).samples.front().state.front();
    const double top = loop.run({Rational(4)}, {.steps = 0}, run).samples.front().state.front();
    EXPECT_GE(bottom, 0);
    EXPECT_LE(top, 4);
    inside += bottom > 0 || top < 4 ? 1 : 0;
  }
  EXPECT_GT(inside, 0);
}

TEST(ClosedLoop, SeedsAndRunsMakeADifference) {
  const auto w = [](std::uint64_t seed, std::uint64_t run) {
    return drift({.steps = 1, .seed = seed}, run).steps.front().disturbance.front();
  };
  EXPECT_EQ(w(1, 0), w(1, 0));
  EXPECT_NE(w(1, 0), w(2, 0));
  EXPECT_NE(w(1, 0), w(1, 1));
}

TEST(RunTrace, LongestSilenceAndSmallestMarginOfAShortRun) {
  const RunTrace trace{.samples = {{.margin = 2}}};
  EXPECT_EQ(trace.longest_silence(), 0);
  EXPECT_EQ(trace.smallest_margin(), 2);
  const RunTrace gone{
      .samples = {{.margin = 2}, {.margin = -1}}, .steps = {{}}, .outcome = Outcome::left_safely};
  EXPECT_EQ(gone.smallest_margin(), 2);
}

TEST(SimulateRuns, AreTheSameForAnyNumberOfThreads) {
  const LoopFixture loop(line_spec(10, "x + u + v", "\"saturate\""), {8, 7, 6, 5, 4, 3, 2, 1, 0, -2});
  const LoopOptions options{.steps = 30, .runs = 40};
  std::vector<std::vector<std::vector<double>>> found;
  for (const int threads : {1, 2, 5}) {
    ThreadTeam team(threads);
    std::vector<std::vector<double>>& one = found.emplace_back();
    for (const RunTrace& trace : simulate_runs(loop.problem(), options, team))
      one.push_back(positions(trace));
  }
  EXPECT_EQ(found[0], found[1]);
  EXPECT_EQ(found[0], found[2]);
  EXPECT_NE(found[0][0], found[0][1]);
}

std::vector<int> starts_by_cell(const LoopFixture& loop, int cells) {
  ThreadTeam team(2);
  std::vector<int> counts(static_cast<std::size_t>(cells), 0);
  for (const RunTrace& trace : simulate_runs(loop.problem(), {.steps = 1, .runs = 3000}, team)) {
    ++counts.at(static_cast<std::size_t>(trace.samples.front().state.front() + 0.5));
  }
  return counts;
}

TEST(SimulateRuns, StartUniformlyInKAndNowhereElse) {
  const LoopFixture loop(line_spec(4, "x"), {0, -1, 3, 1});
  const std::vector<int> counts = starts_by_cell(loop, 4);
  EXPECT_EQ(counts[1], 0);
  for (const std::size_t x : {0U, 2U, 3U}) EXPECT_NEAR(counts[x], 1000, 160);
}

TEST(SimulateRuns, NoneStartsBeyondAStopLimit) {
  std::string spec = line_spec(4, "0*x", "\"stop\"");
  spec.replace(spec.find("discrete"), 8, "continuous");
  const LoopFixture loop(spec, {0, 2, 3, 1});
  const std::vector<int> counts = starts_by_cell(loop, 4);
  // The outer cells are half as wide.
  EXPECT_NEAR(counts[0], 500, 130);
  EXPECT_NEAR(counts[1], 1000, 160);
  EXPECT_NEAR(counts[3], 500, 130);
  ThreadTeam team(1);
  for (const RunTrace& trace : simulate_runs(loop.problem(), {.steps = 1, .runs = 200}, team)) {
    EXPECT_GE(trace.samples.front().state.front(), 0);
    EXPECT_LE(trace.samples.front().state.front(), 3);
  }
}

}  // namespace
}  // namespace coordreq
