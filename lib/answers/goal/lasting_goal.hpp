#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "answers/goal/progress_engine.hpp"
#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "engine/level_map.hpp"
#include "engine/wave_watch.hpp"
#include "spec/spec_types.hpp"

// Goals to stay at and to return to (contract, section 11). Arrival is held as nearness, kTop - arrival, as
// in arrival.hpp: 0 outside K, 1 where arrival is infinite.
namespace coordreq {

/// The inputs to find a lasting goal.
struct LastingProblem {
  const ProgressEngine* progress = nullptr;
  const CellSet* invariant = nullptr;  ///< K
  const CellSet* goal = nullptr;       ///< G
  Synthesis synthesis = Synthesis::maximal;
};

/// Nearness of a goal to stay at: of the least number v of samples outside G that agents can bound, the least
/// solution of v(x) = [x not in G] + min over u of max over f(x,u) of v.
///
/// Two waves in turn, each from a v that is nowhere too low, until nothing changes:
/// 1. In G: v is the least solution for the v outside G that is known. (At first it is infinite there, so
/// that
///    0 is found on H, the greatest subset of G that can be kept.) Nothing is added in G, so that cells take
///    levels of others, and no level has to be counted down to.
/// 2. Everywhere: v sinks to what is forced from the v that is known, as arrival at a goal does.
///
/// Neither goes below the least solution, for it solves both equations. The end is not above it: by induction
/// over n, {v <= n} of the least solution is in that of the end. Outside G its cells force {v <= n - 1}; so
/// the end is at most n there, and with these cells those of G satisfy the first equation with n.
/// The second round differs only where the world decides between G and a cell outside it.
[[nodiscard]] LevelMap find_stay_nearness(const LastingProblem& problem, const WaveWatch& watch,
                                          ThreadTeam& team, WaveCounts& counts);

/// Nearness of a goal to return to: 1 also in cells of G outside W. Y, at first K, shrinks to the cells that
/// can force a cell of G where some action leads into Y (Emerson and Lei); W is what is left.
/// @param after_round called with the nearness after each round: 1 in the cells of K outside the next Y
using AfterRound = std::function<void(const LevelMap& nearness)>;
[[nodiscard]] LevelMap find_return_nearness(const LastingProblem& problem, const WaveWatch& watch,
                                            ThreadTeam& team, WaveCounts& counts,
                                            const AfterRound& after_round = {});

/// The longest time between two visits of a goal to return to; nothing if there are none.
struct LongestReturns {
  std::optional<std::int32_t> forced;      ///< if agents choose best in G
  std::optional<std::int32_t> any_choice;  ///< whatever they choose from P
};
[[nodiscard]] LongestReturns find_longest_returns(const LastingProblem& problem, const LevelMap& nearness,
                                                  ThreadTeam& team);

/// What the least level of a post must be above for the action to be in P: the cell's own level; in the goal
/// one less (`stay`), or that of cells outside W (`return`).
[[nodiscard]] LevelMap progress_bounds(const LastingProblem& problem, const LevelMap& nearness,
                                       GoalThen then);

}  // namespace coordreq
