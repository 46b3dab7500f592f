#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "base/fast_paths.hpp"
#include "engine/alive_rows.hpp"
#include "engine/dirty_rows.hpp"
#include "engine/level_delta.hpp"
#include "engine/tile_memo.hpp"
#include "engine/wave.hpp"
#include "engine/wave_worker.hpp"

namespace coordreq {

/// Works out batches of a wave: chooses the rows that are pending, applies the operator to them, and writes
/// those that have changed, each step by all threads.
///
/// Threads: for one thread, which shares each step with the team. Within a step threads write rows of their
/// own; what they write is read in the next step.
template <class Level>
class WaveBatch {
 public:
  static constexpr Level kTop = LevelRows<Level>::kTop;

  WaveBatch(LevelRows<Level>& levels, const RowEngine& engine, const RowHull& hull, Level limit,
            RowOperator<Level>& op, ThreadTeam& team, const EqualWork& equal)
      : levels_(levels),
        engine_(engine),
        local_(local_rows(engine.share(), engine.rows())),
        limit_(limit),
        op_(op),
        team_(team),
        units_(engine),
        dirty_(engine, hull, units_),
        memo_(equal, levels),
        symmetry_(equal.symmetry),
        alive_(levels, local_, units_.rows(), op.rises(), equal.symmetry, team) {
    const PostReader<Level> posts(engine, levels);
    for (int w = 0; w < team.size(); ++w) workers_.emplace_back(w, posts, dirty_);
    if (fast_paths().level_delta && op.is_minimum() && !engine.posts().is_cut()) delta_.emplace(engine, team);
    for (std::int64_t unit = first_unit(); unit < first_unit() + unit_count(); ++unit) {
      if (alive_.of_unit(unit) > 0) dirty_.set_unseen(unit);
    }
  }

  [[nodiscard]] const RowUnits& units() const { return units_; }
  [[nodiscard]] const AliveRows& alive() const { return alive_; }
  [[nodiscard]] DirtyRows& dirty() { return dirty_; }
  /// The units with rows of this process.
  [[nodiscard]] std::int64_t first_unit() const { return units_.of(local_.begin); }
  [[nodiscard]] std::int64_t unit_count() const {
    return local_.begin == local_.end ? 0 : units_.of(local_.end - 1) + 1 - first_unit();
  }

  void begin_sweep() {
    lowest_ = kTop;
    if (delta_) delta_->begin_sweep(team_);
    memo_.begin_sweep(team_);
  }
  /// To which a cell has sunk in this sweep.
  [[nodiscard]] Level lowest() const { return lowest_; }

  /// @param units none of which has been looked at in this sweep, by their numbers less first_unit()
  /// @param turn ascends from batch to batch by at least the rows of its units
  /// @returns nothing if none of them is pending
  std::optional<BatchCounts> run(std::span<const std::uint32_t> units, std::int64_t turn) {
    counts_ = {};
    dirty_.begin_batch();
    share(std::ssize(units), memo_.is_on() ? kFewAsked : kFewUnits, [&](std::int64_t k, Worker& worker) {
      choose(first_unit() + units[static_cast<std::size_t>(k)], turn + k * units_.rows(), worker);
    });
    list_tasks();
    if (tasks_.empty() && copies_.empty()) {
      dirty_.give_up_batch();
      return std::nullopt;
    }
    visit_tasks();
    if (!memo_.is_on() || memo_.rows() > 1) mark_seen();
    commit();
    copy();
    add_up();
    return counts_;
  }

  /// A ghost row has changed.
  void update_ghost(std::int64_t row) {
    dirty_.mark(row);
    if (delta_) delta_->change(row, levels_.row(row));
    if (memo_.is_on()) memo_.update(row / memo_.rows(), workers_.front().memo.key);
  }

 private:
  /// Fewer units are chosen from, with the memo or without, and fewer rows written, sooner than handed out.
  static constexpr std::int64_t kFewAsked = 16;
  static constexpr std::int64_t kFewUnits = 64;
  static constexpr std::int64_t kFewRows = 16;
  /// Fewer lanes of a row are computed sooner than handed out.
  static constexpr std::int64_t kLanesOfPart = 2048;

  /// A tile that will be equal to another one.
  struct Copy {
    std::int64_t from;
    std::int64_t to;
  };
  using Worker = WaveWorker<Level>;
  using Change = typename Worker::Change;

  [[nodiscard]] Worker& worker(int w) { return workers_[static_cast<std::size_t>(w)]; }

  /// Calls `work(k, worker)` for k below `count`, by all threads unless there are fewer than `few`.
  template <class Work>
  void share(std::int64_t count, std::int64_t few, const Work& work) {
    const std::int64_t tasks = kTasksOfThread * team_.size();
    team_.for_each(count, count < few ? count : std::max({std::int64_t{1}, few / 4, count / tasks}),
                   [&](ThreadTeam::Range range, int w) {
                     for (std::int64_t k = range.begin; k < range.end; ++k) work(k, worker(w));
                   });
  }

  /// share() for rows to be written. Rows that are interned are written by one thread.
  template <class Write>
  void share_writing(std::int64_t count, const Write& write) {
    share(count, levels_.is_interned() ? count + 1 : kFewRows, write);
  }

  /// Adds what is pending of a unit to what the worker has chosen.
  void choose(std::int64_t unit, std::int64_t turn, Worker& worker) {
    if (!dirty_.is_pending(unit, worker.dirty)) return;
    const std::int64_t begin = std::max(unit * units_.rows(), local_.begin);
    const std::int64_t end = std::min((unit + 1) * units_.rows(), local_.end);
    if (!memo_.is_on() || memo_.rows() > 1) {
      worker.chosen.push_back({unit, begin, end, units_.rows() == 1});
      if (!memo_.is_on()) return;
      units_.go_to(unit, worker.dirty.position);
      worker.chosen.back().query = memo_.ask(worker.dirty.position, turn, worker.memo);
      return;
    }
    if (!dirty_.is_unseen(unit)) dirty_.enter(unit, worker.dirty);
    for (RowPosition position(engine_.grid(), begin); position.row < end; position.advance(engine_.grid())) {
      if (!is_to_be_looked_at(position, unit, worker.dirty)) continue;
      const std::uint32_t query = memo_.ask(position, turn + position.row - begin, worker.memo);
      worker.chosen.push_back({unit, position.row, position.row + 1, true, query});
    }
    dirty_.mark_seen(unit);
  }

  [[nodiscard]] bool is_to_be_looked_at(const RowPosition& position, std::int64_t unit,
                                        DirtyRows::Scratch& scratch) const {
    if (!alive_.has(position.row)) return false;
    return dirty_.is_unseen(unit) || dirty_.meets_change(position, unit, scratch);
  }

  /// Divides what was chosen into tasks, and copies of tiles on which the work is equal.
  void list_tasks() {
    tasks_.clear();
    copies_.clear();
    for (Worker& worker : workers_) {
      for (const WaveTask& task : worker.chosen) {
        const std::int64_t tile = memo_.is_on() ? task.begin / memo_.rows() : 0;
        const std::int64_t first = memo_.is_on() ? memo_.first(task.query) : 0;
        if (first == tile) {
          tasks_.push_back(task);
        } else {
          copies_.push_back({first, tile});
        }
      }
      worker.chosen.clear();
    }
    if (memo_.is_on()) memo_.count(std::ssize(tasks_) + std::ssize(copies_), std::ssize(copies_));
  }

  /// Does all tasks; where patches are kept of units those of few units at a time.
  void visit_tasks() {
    if (const std::int64_t parts = parts_of_row(); parts > 1) return visit_in_parts(tasks_.front(), parts);
    const PostReader<Level>& posts = workers_.front().posts;
    const auto most = static_cast<std::size_t>(posts.units_at_once(team_.size()));
    for (std::span<const WaveTask> rest(tasks_); !rest.empty();) {
      const std::size_t count = std::min(most, rest.size());
      divide(rest.first(count));
      rest = rest.subspan(count);
      posts.forget();
      share(std::ssize(pieces_), 2,
            [&](std::int64_t t, Worker& worker) { visit(pieces_[static_cast<std::size_t>(t)], worker); });
    }
  }

  /// pieces_ = these tasks. Where there are few units, their rows are divided between the threads, at the
  /// price that several of them may find the same minima.
  void divide(std::span<const WaveTask> tasks) {
    const std::int64_t wanted = team_.size() == 1 ? 1 : kTasksOfThread * team_.size();
    const std::int64_t segments = (wanted + std::ssize(tasks) - 1) / std::ssize(tasks);
    pieces_.clear();
    for (WaveTask task : tasks) {
      const std::int64_t end = task.end;
      const std::int64_t rows = (end - task.begin + segments - 1) / segments;
      for (; task.begin < end; task.begin = task.end) {
        task.end = std::min(task.begin + rows, end);
        pieces_.push_back(task);
      }
    }
  }

  void visit(const WaveTask& task, Worker& worker) {
    const bool asks_delta = delta_ && !dirty_.is_unseen(task.unit);
    worker.posts.enter(task.begin, asks_delta ? delta_->levels() : levels_);
    if (!task.is_wanted && !dirty_.is_unseen(task.unit)) dirty_.enter(task.unit, worker.dirty);
    RowPosition position(engine_.grid(), task.begin);
    for (; position.row < task.end; position.advance(engine_.grid())) {
      if (task.is_wanted || is_to_be_looked_at(position, task.unit, worker.dirty))
        visit_row(position, worker);
    }
  }

  /// In how many parts the row is computed that is all the work of this batch: one where there is more.
  [[nodiscard]] std::int64_t parts_of_row() const {
    if (tasks_.size() != 1 || !engine_.posts().is_cut()) return 1;
    if (!tasks_.front().is_wanted || tasks_.front().end - tasks_.front().begin > 1) return 1;
    return std::min<std::int64_t>(team_.size(), levels_.row_length() / kLanesOfPart);
  }

  /// Divides the lanes of a row between the threads, and joins what they find.
  void visit_in_parts(const WaveTask& task, std::int64_t parts) {
    workers_.front().posts.forget();
    const RowPosition position(engine_.grid(), task.begin);
    std::vector<Level> joined(levels_.row(task.begin), levels_.row(task.begin) + levels_.row_length());
    std::atomic<bool> is_changed = false;
    share(parts, 2, [&](std::int64_t part, Worker& worker) {
      const auto lane = [&](std::int64_t p) {
        return static_cast<std::size_t>(levels_.row_length() * p / parts);
      };
      const LaneRange lanes{lane(part), lane(part + 1)};
      worker.posts.enter(task.begin, levels_);
      worker.posts.set_lanes(lanes);
      if (worker.find(levels_, op_, limit_, position, lanes)) {
        std::copy_n(worker.result.begin() + static_cast<std::ptrdiff_t>(lanes.begin), lanes.size(),
                    joined.begin() + static_cast<std::ptrdiff_t>(lanes.begin));
        is_changed = true;
      }
      worker.posts.set_lanes(engine_.all_lanes());
    });
    ++counts_.visited;
    if (is_changed) workers_.front().keep(levels_, task.begin, joined.data());
  }

  void visit_row(const RowPosition& position, Worker& worker) {
    ++worker.counts.visited;
    if (worker.find(levels_, op_, limit_, position, engine_.all_lanes()))
      worker.keep(levels_, position.row, worker.result.data());
  }

  void mark_seen() {
    for (const WaveTask& task : tasks_) dirty_.mark_seen(task.unit);
    for (const Copy& copy : copies_) dirty_.mark_seen(units_.of(copy.to * memo_.rows()));
  }

  /// Writes the rows that have changed.
  void commit() {
    ends_.clear();
    for (const Worker& worker : workers_)
      ends_.push_back((ends_.empty() ? 0 : ends_.back()) + std::ssize(worker.changes));
    const std::int64_t count = ends_.back();
    counts_.changed += count;
    const bool is_interned = levels_.is_interned();
    share(count, is_interned ? kFewUnits : kFewRows, [&](std::int64_t k, Worker& by) {
      const auto owner = static_cast<std::size_t>(std::ranges::upper_bound(ends_, k) - ends_.begin());
      const Worker& from = workers_[owner];
      const Change& change =
          from.changes[static_cast<std::size_t>(k - ends_[owner] + std::ssize(from.changes))];
      note(from, change);
      if (!is_interned) write(from, change, by);
    });
    if (is_interned) {
      for (Worker& worker : workers_) {
        for (const Change& change : worker.changes) write(worker, change, worker);
      }
      levels_.fill_placed(&team_);
    }
    for (Worker& worker : workers_) {
      worker.changes.clear();
      worker.storage.clear();
    }
  }

  void note(const Worker& from, const Change& change) {
    const Level* const after = from.storage.data() + change.offset + levels_.margins().before;
    const auto note_row = [&](std::int64_t row) {
      if (delta_) delta_->change(row, levels_.row(row), after);
      dirty_.mark(row);
    };
    note_row(change.row);
    for_each_permuted(change.row, note_row);
  }

  void write(const Worker& from, const Change& change, Worker& by) {
    levels_.place(change.row, from.storage.data() + change.offset, change.ready);
    for_each_permuted(change.row, [&](std::int64_t permuted) {
      static_cast<void>(levels_.copy_row(change.row, permuted));
      ++by.counts.permuted;
    });
  }

  /// Copies rows on which the work was equal, and numbers the contents of tiles that have changed.
  void copy() {
    const std::int64_t copies = std::ssize(copies_);
    share_writing(copies,
                  [&](std::int64_t k, Worker& by) { copy(copies_[static_cast<std::size_t>(k)], by); });
    if (!memo_.is_on() || memo_.rows() == 1) return;
    share(copies + std::ssize(tasks_), kFewRows, [&](std::int64_t k, Worker& by) {
      if (k < copies) return renumber(copies_[static_cast<std::size_t>(k)].to, by);
      const WaveTask& task = tasks_[static_cast<std::size_t>(k - copies)];
      if (task.begin == task.unit * memo_.rows()) renumber(task.unit, by);
    });
  }

  void copy(const Copy& copy, Worker& by) {
    by.counts.copied += memo_.rows() == 1 ? 1 : alive_.of_unit(copy.to);
    const auto note = [&](std::int64_t row) {
      dirty_.mark(row);
      if (delta_) delta_->change(row, levels_.row(row));
      ++by.counts.changed;
    };
    memo_.copy(copy.from, copy.to, [&](std::int64_t row) {
      note(row);
      for_each_permuted(row, [&](std::int64_t permuted) {
        if (levels_.copy_row(row, permuted)) note(permuted);
        ++by.counts.permuted;
      });
    });
  }

  void renumber(std::int64_t tile, Worker& by) {
    if (!dirty_.has_unit_changed(tile)) return;
    memo_.update(tile, by.memo.key);
    for_each_permuted(tile * memo_.rows(),
                      [&](std::int64_t permuted) { memo_.update(permuted / memo_.rows(), by.memo.key); });
  }

  /// RowSymmetry::for_each_permuted(), if there is a symmetry.
  template <class Visit>
  void for_each_permuted(std::int64_t row, const Visit& visit) const {
    if (symmetry_ != nullptr) symmetry_->for_each_permuted(row, visit);
  }

  void add_up() {
    for (Worker& worker : workers_) {
      counts_.visited += worker.counts.visited;
      counts_.copied += worker.counts.copied;
      counts_.permuted += worker.counts.permuted;
      counts_.changed += worker.counts.changed;
      lowest_ = std::min(lowest_, worker.lowest);
      worker.counts = {};
      worker.lowest = kTop;
    }
  }

  LevelRows<Level>& levels_;
  const RowEngine& engine_;
  RowShare::Range local_;
  Level limit_;
  RowOperator<Level>& op_;
  ThreadTeam& team_;
  RowUnits units_;
  DirtyRows dirty_;
  TileMemo<Level> memo_;
  std::optional<LevelDelta<Level>> delta_;  ///< where less is read so
  const RowSymmetry* symmetry_;             ///< null: there is none
  AliveRows alive_;
  Level lowest_ = kTop;
  BatchCounts counts_;
  std::deque<Worker> workers_;
  std::vector<WaveTask> tasks_;
  std::vector<WaveTask> pieces_;  ///< of some of them, for one thread each
  std::vector<Copy> copies_;
  std::vector<std::int64_t> ends_;  ///< [worker] changes up to its own
};

}  // namespace coordreq
