// Limits that stop a state, met exactly or passed, on systems whose solution is written down: v' = u + r with
// limits, x' = c v + k + r.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "model/pieces.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/read_spec.hpp"
#include "support/draw.hpp"
#include "verify/analysis_tables.hpp"
#include "verify/checks.hpp"

namespace coordreq {
namespace {

ProblemSpec integrator_with_limits() {
  const auto side = [] { return *rc::gen::element<std::string>("stop", "stop", "unsafe"); };
  return read_spec(fmt::format(R"({{"coordreq": 1, "name": "stop",
"states": [{{"name": "x", "lower": -4, "upper": 4, "step": 0.25}},
           {{"name": "v", "lower": {}, "upper": {}, "step": {}, "outside": {{"below": "{}", "above": "{}"}}}}],
"inputs": [{{"name": "u", "values": [-1, 0, 0.5, 1]}}],
"agents": [{{"name": "a", "inputs": ["u"]}}],
"dynamics": {{"time": "continuous", "period": {}, "equations": {{"x": "v", "v": "u"}}}},
"safe": "true", "abstraction": {{"cells": "{}"}}}})",
                               draw(-1, 0), draw(1, 2), *rc::gen::element<std::string>("1", "0.5"), side(),
                               side(), *rc::gen::element<std::string>("0.5", "1", "0.75"),
                               *rc::gen::element<std::string>("closed", "half_open")),
                   "stop");
}

struct Motion {
  Rational x, v;
};

/// The limits of v, far off where it has none.
struct SpeedLimits {
  Rational lower, upper;

  explicit SpeedLimits(const GridDimension& v)
      : lower(v.below == Outside::stop ? v.first : Rational(-99)),
        upper(v.above == Outside::stop ? v.point(v.count - 1) : Rational(99)) {}
};

/// At the end of a period, and whether v was stopped on the way.
Motion solution(const Motion& start, const Rational& u, const Rational& tau, const SpeedLimits& limits,
                bool& is_stopped) {
  const Rational free = start.v + u * tau;
  const Rational end = std::clamp(free, limits.lower, limits.upper);
  is_stopped = is_stopped || end != free;
  if (u == 0) return {.x = start.x + start.v * tau, .v = end};
  const Rational moving = (end - start.v) / u;  // so long
  return {.x = start.x + (start.v + end) / 2 * moving + end * (tau - moving), .v = end};
}

struct HullEnds {
  Rational lower, upper;
  void take(const Rational& value, bool is_first) {
    lower = is_first ? value : std::min(lower, value);
    upper = is_first ? value : std::max(upper, value);
  }
};

/// From the corners of a cell: x and v rise with both, so that the ends are there.
TEST(StopLimits, PostsReachTheEndsOfSolutionsAndNoFartherWhereNobodyIsStopped) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("posts against solutions", [&] {
    const ProblemSpec spec = integrator_with_limits();
    const bool is_closed = spec.abstraction.cells == Cells::closed;
    const Abstraction a = build_abstraction(spec, team);
    const SpeedLimits limits(a.grid[1]);
    for (int attempt = 0; attempt < 40; ++attempt) {
      const std::int64_t cell = draw(std::int64_t{0}, a.grid.cells() - 1);
      const std::int64_t u = draw(std::int64_t{0}, a.inputs.count() - 1);
      const Piece x = pieces(a.grid[0], a.grid.index(cell, 0)).front();
      const Piece v = pieces(a.grid[1], a.grid.index(cell, 1)).front();
      HullEnds ends[2];
      bool is_stopped = false;
      for (int corner = 0; corner < 4; ++corner) {
        const Motion start{.x = corner % 2 == 0 ? x.lower : x.upper,
                           .v = corner / 2 == 0 ? v.lower : v.upper};
        const Motion end = solution(start, a.inputs[0].values[static_cast<std::size_t>(u)],
                                    spec.dynamics.period, limits, is_stopped);
        ends[0].take(end.x, corner == 0);
        ends[1].take(end.v, corner == 0);
      }
      for (std::size_t i = 0; i < 2; ++i) {
        const IndexRange range = a.raw(i, cell, u);
        const Rational radius = a.grid[i].radius();
        RC_ASSERT(a.grid[i].point(range.first) - radius <= ends[i].lower);
        RC_ASSERT(ends[i].upper <= a.grid[i].point(range.last) + radius);
        RC_CLASSIFY(is_stopped, "stopped");
        if (is_stopped) continue;
        RC_CLASSIFY(ends[1].lower == limits.lower || ends[1].upper == limits.upper,
                    "a limit met, not passed");
        const Rational below = a.grid[i].point(range.first) + radius;
        const Rational above = a.grid[i].point(range.last) - radius;
        RC_ASSERT(ends[i].lower <= below && above <= ends[i].upper);
        // No face is enough in half-open cells; the upper end of v can be attained, at a limit.
        RC_ASSERT(is_closed || ends[i].lower < below);
        RC_ASSERT(is_closed || i == 1 || above < ends[i].upper);
      }
    }
  }));
}

/// x' = c v + k + r or v' = u + r, r an unknown of [-1/4, 1/4] at each time; speeds and positions measured
/// with errors, up to a whole step.
struct DisturbedTrain {
  Rational c, k;
  bool acts_on_speed;
  ProblemSpec spec;
};

DisturbedTrain draw_train() {
  const auto one_of = [](std::initializer_list<const char*> choices) {
    return *rc::gen::element<std::string>(choices.begin()[0], choices.begin()[1], choices.begin()[2]);
  };
  const std::string c = one_of({"-1", "1", "0.5"});
  const std::string k = one_of({"0", "-2", "0.25"});
  const bool acts_on_speed = draw(0, 1) == 1;
  const auto side = [] { return *rc::gen::element<std::string>("stop", "stop", "unsafe"); };
  const std::string text = fmt::format(
      R"({{"coordreq": 1, "name": "train",
"states": [{{"name": "x", "lower": -3, "upper": 3, "step": 1, "measurement_error": {}}},
           {{"name": "v", "lower": {}, "upper": 2, "step": 1, "outside": {{"below": "{}", "above": "{}"}},
            "measurement_error": {}}}],
"inputs": [{{"name": "u", "values": [-1, 0, 0.5]}}], "agents": [{{"name": "a", "inputs": ["u"]}}],
"disturbances": [{{"name": "r", "lower": -0.25, "upper": 0.25}}],
"dynamics": {{"time": "continuous", "period": {}, "equations": {{"x": "{} * v + {}{}", "v": "u{}"}}}},
"safe": "true", "abstraction": {{"cells": "{}", "between_samples": true}}}})",
      one_of({"0", "0.25", "1"}), draw(-1, 0), side(), side(), one_of({"0", "0.25", "1"}),
      one_of({"0.5", "1", "2"}), c, k, acts_on_speed ? "" : " + r", acts_on_speed ? " + r" : "",
      *rc::gen::element<std::string>("closed", "half_open"));
  const auto exactly = [](const std::string& decimal) { return Rational(std::stod(decimal)); };
  return {exactly(c), exactly(k), acts_on_speed, read_spec(text, "train")};
}

/// After a time within which the disturbance does not change.
Motion moved(const DisturbedTrain& train, const Motion& start, const Rational& u, const Rational& r,
             const Rational& time, const SpeedLimits& limits) {
  bool is_stopped = false;
  const Rational speed_rate = train.acts_on_speed ? Rational(u + r) : u;
  const Motion change = solution({.x = 0, .v = start.v}, speed_rate, time, limits, is_stopped);
  const Rational drift = train.acts_on_speed ? train.k : Rational(train.k + r);
  return {.x = start.x + train.c * change.x + drift * time, .v = change.v};
}

Rational reach_of(const GridDimension& dimension) {
  return dimension.radius() + dimension.measurement_error;
}

bool is_within(const GridDimension& dimension, IndexRange tube, const Rational& value) {
  return dimension.point(tube.first) - reach_of(dimension) <= value &&
         value <= dimension.point(tube.last) + reach_of(dimension);
}

/// Whether fewer cells would leave out an end.
bool is_least(const GridDimension& dimension, IndexRange tube, const HullEnds& ends) {
  if (tube.first == tube.last) return true;
  return dimension.point(tube.first + 1) - reach_of(dimension) > ends.lower &&
         dimension.point(tube.last - 1) + reach_of(dimension) < ends.upper;
}

/// Where x and v are at both ends of the period, from all corners of a cell and of the disturbance.
struct EndsOfMotion {
  HullEnds x, v;
};

EndsOfMotion ends_of_motion(const DisturbedTrain& train, const Abstraction& a, std::int64_t cell,
                            const Rational& u, const SpeedLimits& limits) {
  const Piece x = pieces(a.grid[0], a.grid.index(cell, 0)).front();
  const Piece v = pieces(a.grid[1], a.grid.index(cell, 1)).front();
  EndsOfMotion ends{.x = {x.lower, x.upper}, .v = {v.lower, v.upper}};
  for (int corner = 0; corner < 8; ++corner) {
    const Motion start{.x = corner % 2 == 0 ? x.lower : x.upper,
                       .v = corner / 2 % 2 == 0 ? v.lower : v.upper};
    const Rational r(corner / 4 == 0 ? -1 : 1, 4);
    const Motion end = moved(train, start, u, r, train.spec.dynamics.period, limits);
    ends.x.take(end.x, false);
    ends.v.take(end.v, false);
  }
  return ends;
}

/// Whether x' has one sign, whatever speed and disturbance it meets.
bool keeps_direction(const DisturbedTrain& train, const HullEnds& v) {
  HullEnds rate{};
  const Rational spread = train.acts_on_speed ? 0 : Rational(1, 4);
  for (const Rational& speed : {v.lower, v.upper}) {
    rate.take(train.c * speed + train.k - spread, &speed == &v.lower);
    rate.take(train.c * speed + train.k + spread, false);
  }
  return rate.lower >= 0 || rate.upper <= 0;
}

void attack_tubes_of(const DisturbedTrain& train, const Abstraction& a) {
  const SpeedLimits limits(a.grid[1]);
  const std::int64_t cell = draw(std::int64_t{0}, a.grid.cells() - 1);
  const std::int64_t u = draw(std::int64_t{0}, a.inputs.count() - 1);
  const Rational& input = a.inputs[0].values[static_cast<std::size_t>(u)];
  const auto within = [](const Rational& lower, const Rational& upper) {
    return Rational(lower + (upper - lower) * Rational(draw(0, 4), 4));
  };
  const Piece x = pieces(a.grid[0], a.grid.index(cell, 0)).front();
  const Piece v = pieces(a.grid[1], a.grid.index(cell, 1)).front();
  Motion now{.x = within(x.lower, x.upper), .v = within(v.lower, v.upper)};
  for (int segment = 0; segment < 6; ++segment) {
    now = moved(train, now, input, within(Rational(-1, 4), Rational(1, 4)), train.spec.dynamics.period / 6,
                limits);
    RC_ASSERT(is_within(a.grid[0], a.raw_tube(0, cell, u), now.x));
    RC_ASSERT(is_within(a.grid[1], a.raw_tube(1, cell, u), now.v));
  }
  const EndsOfMotion ends = ends_of_motion(train, a, cell, input, limits);
  const bool may_stop = a.grid[1].below == Outside::stop || a.grid[1].above == Outside::stop;
  const bool is_straight = may_stop && keeps_direction(train, ends.v);
  RC_ASSERT(!may_stop || is_least(a.grid[1], a.raw_tube(1, cell, u), ends.v));
  RC_ASSERT(!is_straight || is_least(a.grid[0], a.raw_tube(0, cell, u), ends.x));
}

TEST(StopLimits, TubesHoldSolutionsAndEndWhereMotionInOneDirectionDoes) {
  ThreadTeam team(1);
  EXPECT_TRUE(rc::check("tubes against solutions", [&] {
    const DisturbedTrain train = draw_train();
    const Abstraction a = build_abstraction(train.spec, team);
    for (int attempt = 0; attempt < 40; ++attempt) attack_tubes_of(train, a);
    const std::vector<std::int64_t> all;
    AnalysisTables tables(train.spec, a.grid, a.inputs, all, team);
    Budget budget(work_of_seconds(60));
    const std::vector<std::uint8_t> safe(static_cast<std::size_t>(a.grid.cells()), 1);
    const CheckedTubes checked = check_tubes(train.spec, a.grid, a.inputs, tables, safe, budget, team);
    for (const Finding& finding : checked.findings) RC_ASSERT(finding.wrong == 0);
  }));
}

}  // namespace
}  // namespace coordreq
