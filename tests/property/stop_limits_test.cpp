// Limits that stop a state, met exactly or passed, on systems whose solution is written down: v' = u with
// limits, x' = v.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "model/pieces.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/read_spec.hpp"
#include "support/draw.hpp"

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

}  // namespace
}  // namespace coordreq
