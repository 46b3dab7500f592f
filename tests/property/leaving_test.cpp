// Which unbounded cells are so because runs leave through a `safe` side: against the definition, one cell and
// one joint input at a time.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "answers/countdown/leaving_cells.hpp"
#include "answers/step_codes.hpp"
#include "model/input_class.hpp"
#include "spec/read_spec.hpp"
#include "support/agreement.hpp"
#include "support/plain_posts.hpp"
#include "support/random_goal.hpp"
#include "support/random_like_agents.hpp"
#include "support/random_problem.hpp"

namespace coordreq {
namespace {

bool leaves_safely(const Abstraction& abstraction, std::int64_t x, std::int64_t u) {
  for (std::size_t i = 0; i < abstraction.grid.size(); ++i) {
    const GridDimension& dimension = abstraction.grid[i];
    const IndexRange raw = abstraction.raw(i, x, u);
    if (dimension.below == Outside::safe && raw.first < 0) return true;
    if (dimension.above == Outside::safe && raw.last >= dimension.count) return true;
  }
  return false;
}

/// |Z_F \ Y|, see count_leaving_cells().
std::int64_t leaving_plainly(const ProblemSpec& spec, const FastAnalysis& fast, const PlainAnalysis& plain,
                             std::size_t p) {
  const Abstraction& abstraction = fast.abstraction;
  const std::vector<InputClass> classes =
      input_classes(spec, abstraction.inputs, spec.coordination.partitions[p]);
  const PlainAnalysis::Partition& own = plain.partitions[p];
  std::vector<bool> staying;
  for (const std::int32_t delay : own.delay) staying.push_back(delay == kUnbounded);
  const auto all = std::count(staying.begin(), staying.end(), true);
  const std::vector<bool> safe = members(fast.safe);
  const std::vector<bool> beyond = members(fast.beyond.value_or(fast.safe));
  const PlainPosts posts{abstraction, safe, beyond};
  const auto may_choose = [&](std::size_t x, std::int64_t u) {
    for (std::size_t c = 0; c < classes.size(); ++c)
      if (!own.projection[c][x][static_cast<std::size_t>(classes[c].action(u))]) return false;
    return true;
  };
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::size_t x = 0; x < staying.size(); ++x) {
      if (!staying[x] || (!plain.terminal.empty() && plain.terminal[x])) continue;
      for (std::int64_t u = 0; u < abstraction.inputs.count() && staying[x]; ++u) {
        if (!may_choose(x, u)) continue;
        const auto cell = static_cast<std::int64_t>(x);
        if (!leaves_safely(abstraction, cell, u) && posts.stays_in(cell, u, staying)) continue;
        staying[x] = false;
        has_changed = true;
      }
    }
  }
  return all - std::count(staying.begin(), staying.end(), true);
}

/// What of the tested cases there are.
struct SeenLeaving {
  bool some = false, all = false, none = false;
};

void expect_same_leaving(const ProblemSpec& spec, ThreadTeam& team) {
  const FastAnalysis fast(spec, team);
  const PlainAnalysis plain = plainly(spec, fast);
  SeenLeaving seen;
  for (std::size_t p = 0; p < plain.partitions.size(); ++p) {
    const std::optional<LeavingCounts>& leaving = fast.layers[p].leaving;
    const bool is_asked = has_safe_side(spec) && !fast.layers[p].truncated &&
                          spec.coordination.partitions[p].classes.size() > 1;
    RC_ASSERT(leaving.has_value() == is_asked);
    if (!leaving) continue;
    RC_ASSERT(leaving->cells == leaving_plainly(spec, fast, plain, p));
    const std::int64_t unbounded = fast.layers[p].sizes.back();
    seen.some = seen.some || (leaving->cells > 0 && leaving->cells < unbounded);
    seen.all = seen.all || (leaving->cells > 0 && leaving->cells == unbounded);
    seen.none = seen.none || (leaving->cells == 0 && unbounded > 0);
  }
  RC_CLASSIFY(seen.some, "some leave");
  RC_CLASSIFY(seen.all, "all leave");
  RC_CLASSIFY(seen.none, "none leaves");
}

TEST(Leaving, IsWhatTheDefinitionSays) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("on random problems", [&] {
    const RandomTime time = *rc::gen::inRange(0, 4) == 0 ? RandomTime::between_samples : RandomTime::any;
    std::string problem = draw_problem(time, RandomEdges::any,
                                       *rc::gen::arbitrary<bool>() ? RandomAgents::many : RandomAgents::few);
    if (*rc::gen::inRange(0, 3) == 0) problem = perhaps_with_goal(problem);
    expect_same_leaving(read_spec(problem, "random"), team);
  }));
}

/// How many of these cells leave. @param states and what else differs, as JSON
std::int64_t leaving_of(const std::string& states, const std::string& equations, const std::string& allow) {
  ThreadTeam team(2);
  const std::string problem = R"({"coordreq": 1, "name": "leaving", "states": )" + states + R"(,
    "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [0, 1]}],
    "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
    "dynamics": {"time": "discrete", "period": 1, "equations": )" +
                              equations + R"(}, "safe": "true",
    "controller": {"allow": ")" +
                              allow + R"("}, "abstraction": {"cells": "half_open"}})";
  return FastAnalysis(read_spec(problem, "test"), team).layers[0].leaving.value().cells;
}

TEST(Leaving, IsByAdmissibleInputsAlone) {
  EXPECT_EQ(leaving_of(R"([{"name": "x", "lower": 0, "upper": 9, "step": 1,
                            "outside": {"below": "saturate", "above": "safe"}}])",
                       R"({"x": "x + 2 * u"})", "x >= 7 or u <= 0"),
            3);
}

TEST(Leaving, IsThroughCellsThatLeaveAlone) {
  // From 1 they leave, and from 3 to 1; from 2 and 4 none does.
  EXPECT_EQ(leaving_of(R"([{"name": "x", "lower": 0, "upper": 4, "step": 1,
                            "outside": {"below": "safe", "above": "saturate"}},
                           {"name": "y", "lower": 0, "upper": 4, "step": 1, "outside": "saturate"}])",
                       R"({"x": "x + 2 * u", "y": "y + v"})", "x >= 0.5"),
            10);
}

TEST(Leaving, OfLikeAgentsToo) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("of which some rows are worked out alone",
                        [&] { expect_same_leaving(read_spec(draw_like_agents(), "random"), team); }));
}

}  // namespace
}  // namespace coordreq
