// Requirements about goals to stay at and to return to, on random systems: verdicts are those of the plain
// engine, each counterexample is a run that shows what arrival or approach delay says, and what is written
// verifies.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/analysis_stages.hpp"
#include "answers/invariance/safe_set.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "answers/plan.hpp"
#include "answers/requirements/answer.hpp"
#include "base/index.hpp"
#include "model/outside.hpp"
#include "property/plain_region.hpp"
#include "property/real_way.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/read_spec.hpp"
#include "support/analysed_file.hpp"
#include "support/draw.hpp"
#include "support/members.hpp"
#include "support/plain_engine.hpp"
#include "support/plain_goal.hpp"
#include "support/random_goal.hpp"
#include "support/random_requirements.hpp"

namespace coordreq {
namespace {

/// A random system with a lasting goal, and requirements about it that often fail.
std::string draw_lasting() {
  nlohmann::json spec =
      nlohmann::json::parse(with_requirements(draw(0, 1) == 0 ? draw_team() : draw_problem()));
  spec["goal"] = {{"where", draw_goal(spec["states"])},
                  {"then", *rc::gen::element<std::string>("stay", "return")}};
  if (draw(0, 1) == 0) {  // all cells are in K, so that a path begins there
    spec["safe"] = "true";
    for (nlohmann::json& state : spec["states"]) {
      if (!state.contains("outside") || state["outside"] == "unsafe") state["outside"] = "saturate";
    }
  }
  const ProblemSpec read = read_spec(spec.dump(), "random");
  const auto most = static_cast<int>(std::min<std::int64_t>(read.coordination.max_delay.value_or(3), 3));
  for (nlohmann::json& requirement : spec["requirements"]) {
    nlohmann::json asked = {{"name", requirement["name"]}, {"where", requirement["where"]}};
    if (draw(0, 2) == 0) asked["where"] = "true";
    if (draw(0, 2) > 0 || most == 0) {
      asked["max_arrival"] = draw(0, 1);
    } else {
      asked["partition"] = pick(read.coordination.partitions).name;
      asked["min_approach_delay"] = draw(1, most);
    }
    requirement = asked;
  }
  return spec.dump();
}

struct Lasting {
  Lasting(const std::string& text, ThreadTeam& team)
      : spec(read_spec(text, "random")),
        abstraction(build_abstraction(spec, team)),
        safe(safe_set(spec, abstraction, team)),
        beyond(safe_beyond_limits(spec, abstraction, safe, team)),
        plain(analyze_plainly(spec, abstraction, members(safe), members(beyond.value_or(safe)))),
        in_goal(members(cells_that_satisfy(*spec.goal, spec, abstraction.grid, abstraction.inputs, team))),
        goal(reach_goal_plainly(spec, abstraction, members(safe), members(beyond.value_or(safe)), plain,
                                in_goal)) {
    const Model model = make_model(spec);
    Answers answers(model);
    run_stages(analysis_stages(spec), answers, {.team = team});
    requirements = answers.get<RequirementVerdicts>().requirements;
  }

  [[nodiscard]] std::int32_t value(const RequirementSpec& asked, std::size_t x) const {
    if (asked.kind == RequirementKind::max_arrival) return goal.arrival[x];
    return goal.partitions[at(*asked.partition)].delay[x];
  }
  [[nodiscard]] bool is_stay() const { return spec.goal_then == GoalThen::stay; }
  [[nodiscard]] bool leaves_through_safe_side(std::size_t x, std::int64_t u) const {
    for (std::size_t i = 0; i < abstraction.grid.size(); ++i) {
      const IndexRange raw = abstraction.raw(i, static_cast<std::int64_t>(x), u);
      const GridDimension& dimension = abstraction.grid[i];
      if (raw.first < 0 && dimension.below == Outside::safe) return true;
      if (raw.last >= dimension.count && dimension.above == Outside::safe) return true;
    }
    return false;
  }
  /// Whether each class has its action of u in some joint input of P(x).
  [[nodiscard]] bool is_independent(std::size_t p, std::size_t x, std::int64_t u) const {
    const InputSpace& inputs = abstraction.inputs;
    return std::ranges::all_of(spec.coordination.partitions[p].classes, [&](const auto& agents) {
      for (std::int64_t v = 0; v < inputs.count(); ++v) {
        const bool is_equal = std::ranges::all_of(agents, [&](std::int32_t agent) {
          return std::ranges::all_of(spec.agents[at(agent)].inputs, [&](std::int32_t i) {
            return inputs.index(u, at(i)) == inputs.index(v, at(i));
          });
        });
        if (is_equal && goal.progress[x][at(v)]) return true;
      }
      return false;
    });
  }
  /// The greatest arrival after a step of progress.
  [[nodiscard]] std::int32_t limit(std::size_t x) const {
    if (is_stay()) return goal.arrival[x] - (in_goal[x] ? 0 : 1);
    return goal.arrival[x] == 0 ? INT32_MAX - 1 : goal.arrival[x] - 1;
  }

  ProblemSpec spec;
  Abstraction abstraction;
  CellSet safe;
  std::optional<CellSet> beyond;
  PlainAnalysis plain;
  std::vector<bool> in_goal;
  PlainGoal goal;
  std::vector<ResultRequirement> requirements;
};

void expect_run(const Lasting& all, const ResultPath& path) {
  for (std::size_t s = 0; s + 1 < path.samples(); ++s) {
    const auto cells = post_cells(all.abstraction, static_cast<std::int64_t>(path.cell[s]),
                                  input_of(all.abstraction, path, s));
    RC_ASSERT(cells.has_value());
    RC_ASSERT(std::count(cells->begin(), cells->end(), static_cast<std::int64_t>(path.cell[s + 1])) > 0);
  }
}

/// As few samples outside as agents can force, and no fewer; or a cycle that shows that there is no bound.
void expect_together(const Lasting& all, const ResultPath& path) {
  const std::int32_t arrival = all.goal.arrival[path.cell.front()];
  for (std::size_t s = 0; s < path.steps(); ++s) {
    RC_ASSERT(path.phase[s] == PathPhase::together);
    RC_ASSERT(all.plain.controller[path.cell[s]][at(input_of(all.abstraction, path, s))]);
  }
  const bool stays = path.samples() > path.steps();
  if (arrival != INT32_MAX) {
    const auto outside = std::ranges::count_if(path.cell, [&](std::uint64_t x) { return !all.in_goal[x]; });
    RC_CLASSIFY(all.is_stay() && outside + 1 < std::ssize(path.cell), "in the goal, and out of it again");
    RC_ASSERT(path.end == PathEnd::arrived);
    RC_ASSERT((all.is_stay() ? outside : static_cast<std::int64_t>(path.steps())) == arrival);
    if (stays) RC_ASSERT(all.goal.arrival[path.cell.back()] == 0);
    return;
  }
  RC_ASSERT(path.end == PathEnd::never_arrives);
  for (const std::uint64_t x : path.cell) RC_ASSERT(all.goal.arrival[x] == INT32_MAX);
  const std::size_t last = path.steps() - 1;
  RC_CLASSIFY(!stays, "through a safe side");
  // What the world can do at once, it does.
  for (std::size_t s = 0; s < path.steps(); ++s)
    RC_ASSERT(all.leaves_through_safe_side(path.cell[s], input_of(all.abstraction, path, s)) ==
              (!stays && s == last));
  if (!stays) return;
  const auto first = std::find(path.cell.begin(), path.cell.end(), path.cell.back());
  RC_ASSERT(first != path.cell.end() - 1);
  const auto inside =
      std::count_if(first + 1, path.cell.end(), [&](std::uint64_t x) { return all.in_goal[x]; });
  RC_CLASSIFY(all.is_stay() && inside > 0, "a cycle through the goal");
  RC_ASSERT((all.is_stay() ? inside < path.cell.end() - first - 1 : inside == 0));
}

/// The shortest way of agents who act alone to a step without progress.
void expect_approach(const Lasting& all, const RequirementSpec& asked, const ResultPath& path) {
  const std::size_t p = at(*asked.partition);
  const std::int32_t delay = all.value(asked, path.cell.front());
  RC_CLASSIFY(all.in_goal[path.cell.front()], "from the goal");
  RC_ASSERT(path.steps() == at(delay + 1));
  for (std::size_t s = 0; s < path.steps(); ++s) {
    RC_ASSERT(path.phase[s] == PathPhase::approaching);
    RC_ASSERT(all.value(asked, path.cell[s]) == delay - static_cast<std::int32_t>(s));
    RC_ASSERT(all.is_independent(p, path.cell[s], input_of(all.abstraction, path, s)));
  }
  if (path.end != PathEnd::time_lost) return;
  const std::size_t x = path.cell[path.steps() - 1];
  if (path.samples() == path.steps()) {
    RC_ASSERT(all.leaves_through_safe_side(x, input_of(all.abstraction, path, path.steps() - 1)));
    return;
  }
  const std::int32_t next = all.goal.arrival[path.cell.back()];
  RC_ASSERT(next < 0 || next > all.limit(x));
}

void expect_plain_verdict(const Lasting& all, std::size_t r) {
  const RequirementSpec& asked = all.spec.requirements[r];
  const ResultRequirement& found = all.requirements[r];
  const PlainRegion region(all.spec, asked.where, all.abstraction.grid);
  const bool is_limit = asked.kind == RequirementKind::max_arrival;
  std::uint64_t least = 0, most = 0;
  for (std::size_t x = 0; x < region.natural.size(); ++x) {
    const std::int32_t value = all.value(asked, x);
    const bool fails = value < 0 || (is_limit ? value > asked.steps : value < asked.steps);
    least += region.sampled[x] && fails ? 1U : 0U;
    most += region.natural[x] && fails ? 1U : 0U;
  }
  RC_ASSERT(least <= found.failing);
  RC_ASSERT(found.failing <= most);
  RC_ASSERT(found.path.has_value() == (found.failing > 0));
  if (!found.path) return;
  const std::size_t start = found.path->cell.front();
  RC_ASSERT(all.value(asked, start) == found.least_delay);
  RC_CLASSIFY(all.plain.invariant[start], "a path in the invariance set");
  RC_CLASSIFY(found.path->steps() > 2, "a path of more than two steps");
  expect_run(all, *found.path);
  if (!all.plain.invariant[start]) return;
  if (is_limit || all.goal.arrival[start] == INT32_MAX) {
    expect_together(all, *found.path);
  } else {
    expect_approach(all, asked, *found.path);
  }
}

TEST(LastingRequirements, AreJudgedAsThePlainEngineDoesAndShown) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("verdicts and counterexamples of lasting goals", [&] {
    const Lasting all(draw_lasting(), team);
    for (std::size_t r = 0; r < all.spec.requirements.size(); ++r) expect_plain_verdict(all, r);
  }));
}

TEST(LastingRequirements, ThatWereWrittenVerify) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("files with requirements about lasting goals hold", [&] {
    const Verification result =
        verify_file(analysed_file(draw_lasting(), team), {.budget_seconds = 0.1}, team);
    RC_LOG(complaints(result));
    RC_ASSERT(result.holds());
  }));
}

}  // namespace
}  // namespace coordreq
