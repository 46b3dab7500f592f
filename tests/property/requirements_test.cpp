// Requirements on random systems of up to four agents: verdicts are what the definitions say cell by cell,
// every counterexample is a real way out of the safe set and a shortest one, and what is written verifies.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <optional>

#include "analysis/analysis_stages.hpp"
#include "answers/invariance/safe_set.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "answers/plan.hpp"
#include "answers/requirements/answer.hpp"
#include "answers/requirements/result_requirement.hpp"
#include "base/index.hpp"
#include "property/plain_region.hpp"
#include "property/real_way.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/read_spec.hpp"
#include "spec/sight.hpp"
#include "support/analysed_file.hpp"
#include "support/draw.hpp"
#include "support/members.hpp"
#include "support/plain_blind.hpp"
#include "support/plain_engine.hpp"
#include "support/plain_goal.hpp"
#include "support/plain_silence.hpp"
#include "support/random_requirements.hpp"
#include "support/random_sight.hpp"
#include "support/random_silence.hpp"

namespace coordreq {
namespace {

/// The verdicts on a spec, and the same system analysed the plain way.
struct Both {
  Both(const std::string& text, ThreadTeam& team)
      : spec(read_spec(text, "random")),
        requirements(judged(spec, team)),
        abstraction(build_abstraction(spec, team)),
        safe(safe_set(spec, abstraction, team)),
        beyond(safe_beyond_limits(spec, abstraction, safe, team)),
        plain(analyze_plainly(spec, abstraction, members(safe), members(beyond.value_or(safe)))) {
    if (has_limited_sight(spec)) {
      blind = silence_plainly(spec, abstraction, members(safe), members(beyond.value_or(safe)), plain);
    }
    if (spec.silence)
      told = told_silence_plainly(spec, abstraction, members(safe), members(beyond.value_or(safe)), plain);
    if (!spec.goal) return;
    const CellSet satisfying =
        cells_that_satisfy(*spec.goal, spec, abstraction.grid, abstraction.inputs, team);
    goal = reach_goal_plainly(spec, abstraction, members(safe), members(beyond.value_or(safe)), plain,
                              members(satisfying));
  }

  static std::vector<ResultRequirement> judged(const ProblemSpec& spec, ThreadTeam& team) {
    const Model model = make_model(spec);
    Answers answers(model);
    run_stages(analysis_stages(spec), answers, {.team = team});
    return answers.get<RequirementVerdicts>().requirements;
  }

  /// What a requirement judges a cell by, as in `/delay` of the partition that it means, `/blind_delay`,
  /// `/arrival` or `/approach_delay`.
  [[nodiscard]] std::int32_t delay(const RequirementSpec& requirement, std::size_t x) const {
    if (requirement.kind == RequirementKind::max_arrival) return goal->arrival[x];
    if (requirement.kind == RequirementKind::min_approach_delay)
      return goal->partitions[at(*requirement.partition)].delay[x];
    if (requirement.kind == RequirementKind::min_blind_delay)
      return blind->partitions[at(*requirement.partition)].delay[x];
    if (requirement.kind == RequirementKind::min_silence)
      return told->partitions[at(*requirement.partition)].silence[x];
    if (requirement.partition) return plain.partitions[at(*requirement.partition)].delay[x];
    return !safe.test(static_cast<std::int64_t>(x)) ? -2 : plain.invariant[x] ? INT32_MAX : -1;
  }

  ProblemSpec spec;
  std::vector<ResultRequirement> requirements;
  Abstraction abstraction;
  CellSet safe;
  std::optional<CellSet> beyond;
  PlainAnalysis plain;
  std::optional<PlainBlind> blind;
  std::optional<PlainSilence> told;
  std::optional<PlainGoal> goal;
};

/// Greater where a cell is better; outside S, K and W it is worst, in this order.
std::int64_t merit(RequirementKind kind, std::int32_t value) {
  if (value < 0) return INT64_MIN + (value == -2 ? 0 : value == -1 ? 1 : 2);
  return kind == RequirementKind::max_arrival ? -std::int64_t{value} : std::int64_t{value};
}

bool is_independent_choice(const Both& both, std::size_t p, std::int64_t x, std::int64_t u) {
  const auto& inputs = both.abstraction.inputs;
  const PartitionSpec& partition = both.spec.coordination.partitions[p];
  for (std::size_t c = 0; c < partition.classes.size(); ++c) {
    std::int64_t action = 0;
    std::vector<std::int32_t> own;
    for (const std::int32_t agent : partition.classes[c])
      own.insert(own.end(), both.spec.agents[at(agent)].inputs.begin(),
                 both.spec.agents[at(agent)].inputs.end());
    std::sort(own.begin(), own.end());
    for (const std::int32_t i : own) action = action * inputs[at(i)].count() + inputs.index(u, at(i));
    if (!both.plain.partitions[p].projection[c][at(x)][at(action)]) return false;
  }
  return true;
}

void expect_real_path(const Both& both, const RequirementSpec& asked, const ResultPath& path) {
  std::size_t independent = 0;
  for (std::size_t s = 0; s < path.steps(); ++s) {
    const auto x = static_cast<std::int64_t>(path.cell[s]);
    const std::int64_t u = input_of(both.abstraction, path, s);
    RC_ASSERT(both.plain.invariant[at(x)] == (path.phase[s] == PathPhase::independent));
    if (path.phase[s] == PathPhase::independent) {
      ++independent;
      RC_CLASSIFY(path.end == PathEnd::not_allowed, "ends with what is forbidden");
      RC_ASSERT(is_independent_choice(both, at(*asked.partition), x, u));
    }
    if (s + 1 == path.samples()) {
      const bool is_forbidden = !both.plain.permitted[at(x)][at(u)];
      RC_ASSERT(is_forbidden == (path.end == PathEnd::not_allowed));
      RC_ASSERT(is_forbidden || path.end == PathEnd::left_domain ||
                path.end == PathEnd::unsafe_between_samples);
      // Posts that are only blocked by what happens on the way do not end with the domain's edge.
      RC_ASSERT(is_forbidden || !both.abstraction.tubes.empty() || !post_cells(both.abstraction, x, u));
      continue;
    }
    const auto cells = post_cells(both.abstraction, x, u);
    RC_ASSERT(cells.has_value());
    RC_ASSERT(std::count(cells->begin(), cells->end(), static_cast<std::int64_t>(path.cell[s + 1])) > 0);
  }
  const std::size_t start = path.cell.front();
  const std::int32_t delay = both.delay(asked, start);
  RC_ASSERT(independent == static_cast<std::size_t>(std::max(delay + 1, 0)));
  const std::size_t evasive = path.steps() - independent;
  const bool left_at_once = path.samples() == independent;
  const bool stuck = path.end == PathEnd::no_allowed_action;
  if (!left_at_once) {
    const std::int32_t time = both.plain.collision_time[path.cell[independent]];
    RC_ASSERT(evasive + (stuck ? 1 : 0) == static_cast<std::size_t>(time));
  }
  const std::int32_t soonest = delay < 0 ? both.plain.collision_time[start] : delay + 1;
  RC_ASSERT((path.seen != 0) == (path.steps() > 0));
  RC_ASSERT(path.seen <= 0 || path.seen >= soonest);
  RC_CLASSIFY(path.seen > soonest, "more is seen than is proven");
  const auto value = [&](std::size_t step, std::int64_t y) {
    const bool is_last = both.delay(asked, path.cell[step]) <= 0;
    return is_last ? both.plain.collision_time[at(y)] : both.delay(asked, at(y));
  };
  expect_followed(both.spec, both.abstraction, path, value);
  if (path.end == PathEnd::outside_safe_set)
    RC_ASSERT(!both.safe.test(static_cast<std::int64_t>(path.cell.back())));
  if (asked.kind != RequirementKind::min_delay) return;
  const std::size_t p = at(*asked.partition);
  const auto is_choice = [&](std::int64_t x, std::int64_t u) {
    return both.plain.permitted[at(x)][at(u)] && is_independent_choice(both, p, x, u);
  };
  expect_longest(both.spec, both.abstraction, path, {both.plain.partitions[p].delay, is_choice});
}

/// Of agents who do what they are told: down to no silence by A, and from there by what comes after.
void expect_silent_path(const Both& both, const RequirementSpec& asked, const ResultPath& path) {
  const auto& told = both.told->partitions[at(*asked.partition)];
  const std::int32_t silence = told.silence[path.cell.front()];
  RC_CLASSIFY(silence > 0, "some silence, and a way out of it");
  for (std::size_t s = 0; s < path.steps(); ++s) {
    const std::size_t x = path.cell[s];
    const auto u = at(input_of(both.abstraction, path, s));
    RC_ASSERT((told.silence[x] >= 0) == (path.phase[s] == PathPhase::silent));
    if (path.phase[s] == PathPhase::silent) RC_ASSERT(told.actions[x][u]);
    if (path.phase[s] == PathPhase::silent && s < at(silence))
      RC_ASSERT(told.silence[path.cell[s + 1]] == silence - 1 - static_cast<std::int32_t>(s));
    if (path.phase[s] == PathPhase::afterwards) RC_ASSERT(both.told->then[x][u]);
  }
  RC_ASSERT((path.seen != 0) == (path.steps() > 0));
  RC_ASSERT(path.seen <= 0 || path.seen > silence);
}

void expect_plain_verdict(const Both& both, std::size_t r) {
  const RequirementSpec& asked = both.spec.requirements[r];
  const ResultRequirement& found = both.requirements[r];
  const PlainRegion region(both.spec, asked.where, both.abstraction.grid);
  std::uint64_t least = 0, most = 0, least_failing = 0, most_failing = 0;
  std::int64_t worst = INT64_MAX;
  const bool is_limit = asked.kind == RequirementKind::max_arrival;
  for (std::size_t x = 0; x < region.natural.size(); ++x) {
    const std::int32_t delay = both.delay(asked, x);
    const bool fails = delay < 0 || (is_limit ? delay > asked.steps : delay < asked.steps);
    RC_ASSERT(region.natural[x] || !region.sampled[x]);
    least += region.sampled[x] ? 1U : 0U;
    most += region.natural[x] ? 1U : 0U;
    least_failing += region.sampled[x] && fails ? 1U : 0U;
    most_failing += region.natural[x] && fails ? 1U : 0U;
    if (region.sampled[x]) worst = std::min(worst, merit(asked.kind, delay));
  }
  RC_CLASSIFY(least == most, "region known exactly");
  RC_ASSERT(least <= found.cells);
  RC_ASSERT(found.cells <= most);
  RC_ASSERT(least_failing <= found.failing);
  RC_ASSERT(found.failing <= most_failing);
  RC_ASSERT(merit(asked.kind, found.least_delay) <= worst);
  RC_ASSERT(found.holds == (found.failing == 0 && !found.reached_side));
  RC_ASSERT(found.path.has_value() == (found.failing > 0));
  RC_CLASSIFY(found.holds, "holds");
  if (!found.path) return;
  RC_CLASSIFY(found.path->steps() > 2, "a way out of more than two steps");
  RC_ASSERT(region.natural[found.path->cell.front()]);
  RC_ASSERT(both.delay(asked, found.path->cell.front()) == found.least_delay);
  if (asked.kind == RequirementKind::min_silence) expect_silent_path(both, asked, *found.path);
  // Ways that miss a goal, and those of agents who do not see all, are looked at by `verify`.
  if (asked.kind != RequirementKind::min_delay && asked.kind != RequirementKind::invariant) return;
  expect_real_path(both, asked, *found.path);
}

TEST(Requirements, AreJudgedAsThePlainEngineDoes) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("verdicts and counterexamples", [&] {
    const std::string text = with_requirements(draw_problem());
    const Both both(text, team);
    for (std::size_t r = 0; r < both.spec.requirements.size(); ++r) expect_plain_verdict(both, r);
  }));
}

TEST(Requirements, OfTwoToFourAgentsAreJudgedAsThePlainEngineDoes) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("verdicts and counterexamples of a team", [&] {
    const std::string text = with_requirements(draw_team());
    const Both both(text, team);
    for (std::size_t r = 0; r < both.spec.requirements.size(); ++r) expect_plain_verdict(both, r);
  }));
}

TEST(Requirements, BetweenTheSamplesAreJudgedAsThePlainEngineDoes) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("verdicts and counterexamples with tubes", [&] {
    const std::string text = with_requirements(draw_problem(RandomTime::between_samples));
    const Both both(text, team);
    for (std::size_t r = 0; r < both.spec.requirements.size(); ++r) expect_plain_verdict(both, r);
  }));
}

TEST(Requirements, OfLimitedSightAreJudgedAsThePlainEngineDoes) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("verdicts on blind silence", [&] {
    const std::string text = with_requirements(with_sight(draw_team()));
    const Both both(text, team);
    for (std::size_t r = 0; r < both.spec.requirements.size(); ++r) {
      RC_CLASSIFY(both.spec.requirements[r].kind == RequirementKind::min_blind_delay, "blind");
      expect_plain_verdict(both, r);
    }
  }));
}

TEST(Requirements, OfAgentsWhoAreToldWhatToDoAreJudgedAsThePlainEngineDoes) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("verdicts on silence", [&] {
    const std::string text = with_requirements(with_silence(draw_team()));
    const Both both(text, team);
    for (std::size_t r = 0; r < both.spec.requirements.size(); ++r) expect_plain_verdict(both, r);
  }));
}

TEST(Requirements, HoldAtTheirExactBoundAndNoFurther) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("the worst value is the bound", [&] {
    const int agents = draw(0, 2);
    const std::string system = agents == 0   ? with_sight(draw_problem())
                               : agents == 1 ? with_silence(draw_team())
                                             : draw_problem();
    ProblemSpec spec = read_spec(with_requirements(system), "random");
    const std::vector<ResultRequirement> found = Both::judged(spec, team);
    for (const std::int64_t further : {0, 1}) {
      for (std::size_t r = 0; r < found.size(); ++r) {
        const RequirementKind kind = spec.requirements[r].kind;
        const std::int64_t bound = found[r].least_delay;
        if (bound < 0 || bound == INT32_MAX || kind == RequirementKind::invariant) continue;
        spec.requirements[r].steps = bound + (kind == RequirementKind::max_arrival ? -further : further);
      }
      const std::vector<ResultRequirement> again = Both::judged(spec, team);
      for (std::size_t r = 0; r < found.size(); ++r) {
        const std::int32_t bound = found[r].least_delay;
        if (bound < 0 || bound == INT32_MAX || spec.requirements[r].kind == RequirementKind::invariant)
          continue;
        RC_CLASSIFY(further == 1, requirement_kind_name(spec.requirements[r].kind));
        RC_ASSERT((again[r].failing == 0) == (further == 0));
      }
    }
  }));
}

TEST(Requirements, ThatWereWrittenVerify) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("files with requirements hold", [&] {
    const RandomTime kind = *rc::gen::arbitrary<bool>() ? RandomTime::between_samples : RandomTime::any;
    const std::string system = draw_problem(kind);
    const int kind_of_agents = draw(0, 3);
    const std::string text = with_requirements(kind_of_agents == 0   ? with_sight(system)
                                               : kind_of_agents == 1 ? with_silence(system)
                                                                     : system);
    const Verification result = verify_file(analysed_file(text, team), {.budget_seconds = 0.1}, team);
    RC_LOG(complaints(result));
    RC_ASSERT(result.holds());
  }));
}

std::string of_path(std::size_t requirement, const char* name) {
  return counterexample_path(requirement, name);
}

/// Another number in the verdict that the file could also hold.
void corrupt_verdict(Claims& claims, std::size_t requirement, const UniformGrid& grid) {
  const auto value = [&](const char* name) -> std::int64_t& {
    return claims.fields.at(counterexample_path(name)).integers[requirement];
  };
  switch (draw(0, 3)) {
    case 0:
      value("cells") += 2 * grid.cells();
      return;
    case 1:
      value("failing") = value("failing") == 0 ? 1 : 0;
      return;
    case 2:
      value("least_delay") = value("least_delay") == -2 ? INT32_MAX : -3;
      return;
    default:
      value("holds") = 1 - value("holds");
      return;
  }
}

/// The same in the counterexample. REQUIRES: it has a step.
void corrupt_path(Claims& claims, std::size_t requirement, const UniformGrid& grid) {
  const auto list = [&](const char* name) -> std::vector<std::int64_t>& {
    return claims.fields.at(of_path(requirement, name)).integers;
  };
  std::vector<double>& inputs = claims.fields.at(of_path(requirement, "input")).numbers;
  const std::size_t steps = list("phase").size();
  const auto step = static_cast<std::size_t>(draw(0, static_cast<int>(steps) - 1));
  std::int64_t& seen = claims.fields.at(counterexample_path("seen")).integers[requirement];
  switch (draw(0, 5)) {
    case 0:
      claims.fields.at(of_path(requirement, "state")).numbers[step * grid.size()] += 1;
      return;
    case 1:
      list("delay")[step] += 1;
      return;
    case 2:
      inputs[step * inputs.size() / steps] = 17;
      return;
    case 3:
      list("phase")[step] = list("phase")[step] == 1 ? 0 : 1;  // evasive, independent
      return;
    case 4:
      seen = seen == ResultPath::kNotFollowed ? 3 : ResultPath::kNotFollowed;
      return;
    default:
      list("cell")[step] = (list("cell")[step] + 1) % grid.cells();
      return;
  }
}

TEST(Requirements, OneOtherNumberIsFound) {
  ThreadTeam team(2);
  EXPECT_TRUE(rc::check("a corrupted requirement does not hold", [&] {
    const std::string text = with_requirements(draw_problem());
    ClaimedFile file = analysed_file(text, team);
    const auto chosen =
        static_cast<std::size_t>(draw(0, static_cast<int>(file.spec.requirements.size()) - 1));
    if (draw(0, 1) == 0 && file.claims.has(of_path(chosen, "phase"))) {
      corrupt_path(file.claims, chosen, make_grid(file.spec));
    } else {
      corrupt_verdict(file.claims, chosen, make_grid(file.spec));
    }
    RC_ASSERT(!verify_file(file, {}, team).holds());
  }));
}

}  // namespace
}  // namespace coordreq
