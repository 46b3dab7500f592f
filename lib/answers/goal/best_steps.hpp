#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <vector>

#include "answers/goal/lasting_goal.hpp"
#include "base/thread_team.hpp"
#include "choices/joint_actions.hpp"
#include "engine/cell_set.hpp"
#include "engine/level_rows.hpp"
#include "engine/post_reader.hpp"

namespace coordreq {

/// Calls `body(position, posts, best, worker)` for every local row with such cells: what its cells can reach
/// at best.
template <class Level, class Body>
void for_each_best(const LastingProblem& problem, const ActionGrouping& grouping,
                   const LevelRows<Level>& levels, const CellSet& cells, ThreadTeam& team, const Body& body) {
  const RowEngine& engine = problem.progress->engine();
  const auto best = make_joint_actions<Level>(grouping, problem.synthesis, true, team.size());
  const PostReader<Level> first(engine, levels);
  std::deque<PostReader<Level>> readers(static_cast<std::size_t>(team.size()), first);
  first.for_each_local_row(team, [&](ThreadTeam::Range range, int worker) {
    PostReader<Level>& posts = readers[static_cast<std::size_t>(worker)];
    std::vector<Level> old(posts.lanes(), 0), next(posts.lanes(), 0);
    for (RowPosition position(engine.grid(), range.begin); position.row < range.end;
         position.advance(engine.grid())) {
      posts.enter(position.row);
      if (!any_set(cells.row(position.row))) continue;
      std::copy_n(levels.row(position.row), engine.row_length(), old.begin());
      best->next_levels(position, posts, old.data(), next.data(), worker);
      body(position, posts, next.data(), worker);
    }
  });
}

}  // namespace coordreq
