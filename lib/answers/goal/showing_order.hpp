#pragma once

#include "answers/goal/lasting_goal.hpp"
#include "base/thread_team.hpp"
#include "engine/level_map.hpp"

namespace coordreq {

/// By which of several worst cells the world comes soonest to what shows the arrival of a lasting goal
/// (contract, section 11, "Counterexamples"); the least is the best for it, kTop: it need not be shown.
///
/// - `stay`: in how many steps it can force a sample outside G without losing any, 0 outside G. Each round
///   adds the cells of G from which, whatever agents choose, it reaches a cell of an earlier round whose
///   arrival is no less.
/// - `return`: in which round the cell has fallen, of those that shrink Y from K to W; kTop in W.
///
/// Of several processes together; in the rows held. Cost: `stay` a look at all rows of G a round, `return`
/// that of find_return_nearness().
/// @param nearness the solution
[[nodiscard]] LevelMap find_showing_order(const LastingProblem& problem, const LevelMap& nearness,
                                          GoalThen then, ThreadTeam& team);

}  // namespace coordreq
