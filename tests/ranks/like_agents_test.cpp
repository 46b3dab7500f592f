// Agents that are alike, where several processes share the work: here processes are threads.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <vector>

#include "answers/answers.hpp"
#include "answers/ground/answer.hpp"
#include "answers/invariance/invariance.hpp"
#include "answers/plan.hpp"
#include "base/json.hpp"
#include "model/model.hpp"
#include "reach/table_shapes.hpp"
#include "spec/read_spec.hpp"
#include "support/random_like_agents.hpp"
#include "support/thread_ranks.hpp"

namespace coordreq {
namespace {

constexpr int kCounts[] = {1, 2, 3, 5};

/// What one process finds without a word of agents.
struct Expected {
  CellSet safe;
  LevelMap collision_time;
};

Expected alone(const Model& model) {
  ThreadTeam team(1);
  Answers answers(model);
  run_stages(ground_stages(model.spec()), answers, {.team = team});
  const Ground& ground = answers.ground;
  Invariance found =
      find_invariance(*ground.engine, *ground.hull, ground.safe, model.spec().controller.synthesis, {}, team);
  return {ground.safe, std::move(found.collision_time)};
}

/// What the rows of a rank hold after work that was broken off, and that knew nothing of images: some rows of
/// it are done, and some are not.
LevelMap begun(const Ground& ground, const Expected& expected, const std::vector<int>& is_done,
               ThreadTeam& team) {
  auto levels = ground.engine->make_levels<std::uint8_t>(ground.safe, team);
  for (const RowShare::Range run : ground.share->held()) {
    for (std::int64_t row = run.begin; row < run.end; ++row) {
      if (is_done[static_cast<std::size_t>(row) % is_done.size()] == 0) continue;
      for (std::int64_t lane = 0; lane < levels.row_length(); ++lane) {
        const std::int64_t level = expected.collision_time.at(row * levels.row_length() + lane);
        levels.row(row)[lane] =
            level == LevelMap::kTop ? LevelRows<std::uint8_t>::kTop : static_cast<std::uint8_t>(level);
      }
      levels.close(row);
    }
  }
  return LevelMap(std::move(levels));
}

/// Looks at one rank. @returns whether rows are found once there
bool check_rank(const Model& model, const Expected& expected, const std::vector<int>& is_done, Ranks& ranks,
                std::atomic<int>& wrong) {
  ThreadTeam team(1);
  Answers answers(model, &ranks);
  run_stages(ground_stages(model.spec()), answers, {.team = team});
  const Ground& ground = answers.ground;
  const std::optional<RowMirror> mirror = ground.mirror(single_classes(ground.abstraction->inputs));
  const auto find = [&](const WaveWatch& watch) {
    return find_invariance(*ground.engine, *ground.hull, ground.safe, model.spec().controller.synthesis,
                           watch, team,
                           {.tiles = ground.equal_work(), .mirror = mirror ? &*mirror : nullptr});
  };
  const Invariance found = find({});
  LevelMap start = begun(ground, expected, is_done, team);
  const Invariance again = find({.resumed = &start});
  // In the halo, too.
  for (const RowShare::Range run : ground.share->held()) {
    const std::int64_t length = ground.safe.row_length();
    for (std::int64_t x = run.begin * length; x < run.end * length; ++x) {
      wrong += ground.safe.test(x) != expected.safe.test(x) ? 1 : 0;
      if (!ground.safe.test(x)) continue;
      wrong += found.collision_time.at(x) != expected.collision_time.at(x) ? 1 : 0;
      wrong += again.collision_time.at(x) != expected.collision_time.at(x) ? 1 : 0;
    }
  }
  return mirror.has_value();
}

TEST(LikeAgentsOfManyRanks, AreLookedAtOnceByWhoeverHasTheFirst) {
  EXPECT_TRUE(rc::check("K of 1, 2, 3 and 5 ranks, from the start and resumed", [] {
    Json problem = Json::parse(draw_like_agents());
    problem["coordination"].erase("partitions");  // in all of which few agents can change places
    // Then rows run along the last state, which is often none of an agent.
    problem["output"]["actions"] = *rc::gen::weightedElement<bool>({{3, true}, {1, false}});
    const ProblemSpec spec = read_spec(problem.dump(), "alike");
    const Model model = make_model(spec);
    const Expected expected = alone(model);
    const auto is_done = *rc::gen::container<std::vector<int>>(23, rc::gen::inRange(0, 2));
    bool is_once = false;
    for (const int count : kCounts) {
      std::atomic<int> wrong = 0, mirrors = 0;
      ThreadRanks::run(count, [&](Ranks& ranks) {
        mirrors += check_rank(model, expected, is_done, ranks, wrong) ? 1 : 0;
      });
      RC_ASSERT(wrong == 0);
      RC_ASSERT(mirrors == 0 || mirrors == count);
      is_once = is_once || (count > 1 && mirrors > 0);
    }
    RC_CLASSIFY(is_once, "rows found once");
  }));
}

}  // namespace
}  // namespace coordreq
