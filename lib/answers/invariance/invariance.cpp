#include "answers/invariance/invariance.hpp"

#include <algorithm>

#include "choices/joint_actions.hpp"
#include "engine/find_levels.hpp"

namespace coordreq {

LevelMap find_collision_times(const RowEngine& engine, const RowHull& hull, const CellSet& safe,
                              Synthesis synthesis, const WaveWatch& watch, ThreadTeam& team,
                              WaveCounts& counts, const EqualWork& equal, const CellSet* terminal) {
  // The finest classes give the fewest joint groups to try.
  const ActionGrouping grouping(engine, single_classes(engine.abstraction().inputs), team);
  const int workers = team.size();
  const LevelProblem problem{
      .start = &safe,
      .spared = terminal,
      .equal = equal.by_tables(),
      .make8 = [&] { return make_joint_actions<std::uint8_t>(grouping, synthesis, false, workers); },
      .make16 = [&] { return make_joint_actions<std::uint16_t>(grouping, synthesis, false, workers); },
      .make32 = [&] { return make_joint_actions<std::uint32_t>(grouping, synthesis, false, workers); }};
  return find_levels(engine, hull, problem, watch, team, counts);
}

void follow_from_collision_times(Invariance& invariance, ThreadTeam& team) {
  invariance.invariant = invariance.collision_time.top_cells(team);
  // Synchronously, one sweep loses the cells of each collision time, and one more finds nothing to lose.
  const LevelMap::Histogram levels = invariance.collision_time.histogram(team);
  invariance.iterations = static_cast<std::int64_t>(std::max<std::size_t>(levels.finite.size(), 1));
  invariance.cells = levels.top;
}

Invariance find_invariance(const RowEngine& engine, const RowHull& hull, const CellSet& safe,
                           Synthesis synthesis, const WaveWatch& watch, ThreadTeam& team,
                           const EqualWork& equal, const CellSet* terminal) {
  Invariance result;
  result.collision_time =
      find_collision_times(engine, hull, safe, synthesis, watch, team, result.counts, equal, terminal);
  follow_from_collision_times(result, team);
  return result;
}

}  // namespace coordreq
