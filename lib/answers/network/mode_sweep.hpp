#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "answers/network/mode_choices.hpp"
#include "base/thread_team.hpp"
#include "engine/post_reader.hpp"
#include "engine/wave_watch.hpp"

namespace coordreq {

/// The rows that a sweep computes, ascending.
struct PendingRows {
  std::vector<std::int64_t> rows;
  std::int64_t alive = 0;  ///< rows that it chose them from
};

/// The own rows with cells in a set whose posts can meet a row for which `has_changed(row)` is true.
/// @param all whether all rows are pending, also those whose posts meet none
template <class HasChanged>
PendingRows pending_rows(const NetworkProblem& problem, const CellSet& set, bool all,
                         const HasChanged& has_changed, ThreadTeam& team) {
  const RowEngine& engine = *problem.controller->engine;
  std::vector<std::uint8_t> is_alive(static_cast<std::size_t>(engine.rows()), 0);
  std::vector<std::uint8_t> is_pending(is_alive.size(), 0);
  for_each_local_row(team, engine.share(), engine.rows(), 256, [&](ThreadTeam::Range range, int) {
    RowBox box;
    std::vector<std::int64_t> counter;
    RowPosition position(engine.grid(), range.begin);
    for (; position.row < range.end; position.advance(engine.grid())) {
      if (!any_set(set.row(position.row))) continue;
      const auto row = static_cast<std::size_t>(position.row);
      is_alive[row] = 1;
      if (!all) problem.hull->box(position, box);
      is_pending[row] = all || any_row(engine.grid(), 0, box.ranges, counter, has_changed) ? 1 : 0;
    }
  });
  PendingRows pending{.rows = {}, .alive = std::count(is_alive.begin(), is_alive.end(), 1)};
  for (std::size_t row = 0; row < is_pending.size(); ++row) {
    if (is_pending[row] != 0) pending.rows.push_back(static_cast<std::int64_t>(row));
  }
  return pending;
}

/// Sweeps over the rows of one mode of a network at a time: each finds new levels of its cells from the
/// levels of its target, which follow from the modes after it.
///
/// Threads: called by one thread, which shares rows with the team, those of a unit one after the other.
template <class Level>
class ModeSweep {
 public:
  /// @param levels of some target. @pre unchecked: all outlive this object
  ModeSweep(const NetworkProblem& problem, const ModeChoices& choices, const LevelRows<Level>& levels,
            ThreadTeam& team)
      : engine_(*problem.controller->engine),
        modes_(problem.modes),
        team_(team),
        operators_(choices.operators<Level>(team.size())) {
    const PostReader<Level> posts(engine_, levels);
    for (int w = 0; w < team.size(); ++w) workers_.emplace_back(posts);
  }

  /// Calls `take(row, next, worker)` for all rows that are pending, by several threads. `next` is scratch
  /// memory with the levels of the row: those of one more step for cells of the set, 0 for others.
  template <class Take>
  void run(std::size_t mode, const LevelRows<Level>& target, const PendingRows& pending, const CellSet& set,
           const Take& take) {
    constexpr std::int64_t kTaskRows = 16;
    RowOperator<Level>& op = *operators_[modes_[mode].partition];
    const std::int64_t count = std::ssize(pending.rows);
    workers_.front().posts.forget();
    team_.for_each(count, kTaskRows, [&](ThreadTeam::Range range, int w) {
      Worker& worker = workers_[static_cast<std::size_t>(w)];
      for (std::int64_t i = range.begin; i < range.end; ++i) {
        const std::int64_t row = pending.rows[static_cast<std::size_t>(i)];
        worker.posts.enter(row, target);
        find(op, row, set.row(row), worker, w);
        take(row, worker.next.data(), w);
      }
    });
    ++counts_.sweeps;
    counts_.rows_visited += count;
    counts_.rows_skipped += pending.alive - count;
    step_ = {.sweep = counts_.sweeps, .visited = count, .rows = pending.alive};
  }

  /// Reports the last sweep. @param state [mode] from which work can be resumed; none: it cannot
  template <class State>
  void report(const std::function<void(const WaveStep&)>& watch, std::span<const State> state) const {
    if (!watch) return;
    std::vector<NumberRows> rows;
    for (const State& of_mode : state) rows.push_back(rows_of(of_mode));
    WaveStep step = step_;
    step.state = rows;
    watch(step);
  }

  /// The work of all processes. Together.
  [[nodiscard]] WaveCounts counts() const {
    WaveCounts all = counts_;
    all.rows_visited = sum_of_all(engine_.share(), counts_.rows_visited);
    all.rows_skipped = sum_of_all(engine_.share(), counts_.rows_skipped);
    if (engine_.share() != nullptr) all.sweeps = engine_.share()->ranks().greatest(counts_.sweeps);
    return all;
  }

  [[nodiscard]] const LevelKernels<Level>& kernels() const { return workers_.front().posts.kernels(); }

 private:
  struct Worker {
    explicit Worker(const PostReader<Level>& first)
        : posts(first), old(posts.lanes(), 0), next(posts.lanes(), 0) {}
    PostReader<Level> posts;
    std::vector<Level> old;
    std::vector<Level> next;
  };

  void find(RowOperator<Level>& op, std::int64_t row, ConstRow set, Worker& worker, int w) const {
    const auto n = static_cast<std::size_t>(engine_.row_length());
    kernels().spread(set.data(), worker.old.data(), n);
    // Beyond the row there are no cells.
    std::fill(worker.old.begin() + static_cast<std::ptrdiff_t>(n), worker.old.end(), Level{0});
    const RowPosition position(engine_.grid(), row);
    const bool is_computed = op.next_levels(position, worker.posts, worker.old.data(), worker.next.data(), w);
    const Level* const both[] = {worker.old.data(), is_computed ? worker.next.data() : worker.old.data()};
    kernels().minimum(both, 2, worker.next.data(), n);
  }

  const RowEngine& engine_;
  const std::vector<NetworkMode>& modes_;
  ThreadTeam& team_;
  std::vector<std::unique_ptr<RowOperator<Level>>> operators_;
  std::deque<Worker> workers_;
  WaveCounts counts_;
  WaveStep step_;
};

}  // namespace coordreq
