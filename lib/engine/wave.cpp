#include "engine/wave.hpp"

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "base/fast_paths.hpp"
#include "engine/alive_rows.hpp"
#include "engine/dirty_rows.hpp"
#include "engine/ghost_exchange.hpp"
#include "engine/level_delta.hpp"
#include "engine/tile_memo.hpp"

namespace coordreq {
namespace {

/// Rows of a batch, if units are not larger: few, so that most rows see the levels found just before (batches
/// of 31 instead of 3,000 rows: a tenth of the visits on the intersection of the paper), but enough for
/// threads.
constexpr std::int64_t kBatchRows = 32;
/// Rows of a unit of the wave where the engine shares no minima, so that its unit is the grid.
constexpr std::int64_t kUnitRows = 32;
/// Rows that one thread takes at a time.
constexpr std::int64_t kTaskRows = 8;
/// Below this many levels, handing out the copying costs more than doing it.
constexpr std::size_t kFewLevels = std::size_t{1} << 18;

template <class Level>
class WaveRunner {
 public:
  WaveRunner(LevelRows<Level>& levels, const RowEngine& engine, const RowHull& hull, Level limit,
             RowOperator<Level>& op, const WaveWatch& watch, ThreadTeam& team, const EqualWork& equal)
      : levels_(levels),
        engine_(engine),
        own_(own_rows(engine.share(), engine.rows())),
        limit_(limit),
        op_(op),
        watch_(watch),
        team_(team),
        unit_rows_(std::min(engine.unit_rows(), engine.outer() == 0 ? kUnitRows : engine.unit_rows())),
        dirty_(engine, hull, unit_rows_),
        memo_(equal, levels),
        symmetry_(equal.symmetry),
        alive_(levels, own_, unit_rows_, op.rises(), equal.symmetry) {
    first_unit_ = own_.begin / unit_rows_;
    units_ = (own_.end + unit_rows_ - 1) / unit_rows_ - first_unit_;
    batch_units_ = std::max<std::int64_t>(1, kBatchRows / unit_rows_);
    for (int w = 0; w < team.size(); ++w) workers_.emplace_back(engine, levels);
    for (std::int64_t row = own_.begin; row < own_.end; ++row) {
      if (alive_.has(row)) dirty_.set_unseen(row / unit_rows_);
    }
    if (fast_paths().level_delta && op.is_minimum() && !engine.posts().is_cut()) delta_.emplace(engine, team);
    if (engine.share() != nullptr) ghosts_.emplace(levels, engine, hull, dirty_, unit_rows_);
  }

  /// @returns rows visited
  std::int64_t sweep(std::int64_t number) {
    const bool backwards = number % 2 == 1;
    if (ghosts_) ghosts_->begin_sweep(number, backwards);
    WaveStep step{.sweep = number, .rows_left = alive_.count(), .rows = alive_.count(), .layer = layer_};
    lowest_ = kTop;
    if (delta_) delta_->begin_sweep();
    memo_.begin_sweep();
    std::vector<std::int64_t> batch;
    for (std::int64_t k = 0; k < units_; ++k) {
      const std::int64_t unit = first_unit_ + (backwards ? units_ - 1 - k : k);
      step.rows_left -= alive_.of_unit(unit);
      if (ghosts_) ghosts_->before(unit, [this](std::int64_t row) { hear_of(row); });
      if (alive_.of_unit(unit) > 0 && dirty_.is_pending(unit)) batch.push_back(unit);
      if (static_cast<std::int64_t>(batch.size()) < batch_units_ && (!batch.empty() && k + 1 < units_))
        continue;
      if (!batch.empty()) {
        step.visited += run(batch);
        batch.clear();
        tell(step, !ghosts_);
        if (ghosts_) ghosts_->listen();
      }
      if (ghosts_) ghosts_->after(unit);
    }
    if (ghosts_) ghosts_->end_sweep([this](std::int64_t row) { hear_of(row); });
    // Levels below the lowest to which a cell has sunk in a whole sweep are final: the sets up to it did not
    // change while each cell was found to stay in them. Not so with several processes: changes may be coming.
    if (lowest_ != kTop && engine_.share() == nullptr)
      layer_ = std::max<std::int64_t>(layer_, std::int64_t{lowest_} - 1);
    step.layer = layer_;
    tell(step, true);
    return step.visited;
  }

  /// @returns whether levels may still change. Several processes know a sweep late, so that none waits.
  bool goes_on(std::int64_t sweep, std::int64_t visited) {
    if (!ghosts_) return visited > 0;
    Ranks& ranks = engine_.share()->ranks();
    if (sweep > 1 && ranks.finish_sum() == 0) {
      ghosts_->end();
      return false;
    }
    ranks.begin_sum(std::exchange(changed_rows_, 0));
    return true;
  }

  [[nodiscard]] std::int64_t alive_rows() const { return alive_.count(); }
  [[nodiscard]] std::int64_t copied_rows() const { return copied_; }
  [[nodiscard]] std::int64_t permuted_rows() const { return permuted_count_; }

 private:
  static constexpr Level kTop = LevelRows<Level>::kTop;

  struct Change {
    std::int64_t row;
    std::size_t position;  ///< in the worker's storage
    std::uint64_t ready;   ///< LevelRows::make_ready()
  };
  /// Rows of one unit for one thread.
  struct Task {
    std::int64_t unit;
    std::int64_t begin;
    std::int64_t end;
    bool is_wanted = false;  ///< its rows are known to be pending
  };
  /// A tile that will be equal to another one.
  struct Copy {
    std::int64_t from;
    std::int64_t to;
  };
  struct Worker {
    Worker(const RowEngine& engine, const LevelRows<Level>& levels)
        : posts(engine, levels), old(posts.lanes(), 0), next(posts.lanes(), 0), result(posts.lanes(), 0) {}
    PostReader<Level> posts;
    std::vector<Level> old;
    std::vector<Level> next;
    std::vector<Level> result;
    std::vector<Level> storage;
    std::vector<Change> changes;
    DirtyRows::Scratch dirty;
    std::int64_t visited = 0;
    Level lowest = kTop;      ///< to which a cell has sunk
    std::uint32_t batch = 0;  ///< in which the reader was entered
    std::int64_t unit = -1;   ///< that the reader was entered for
  };

  std::int64_t run(const std::vector<std::int64_t>& batch) {
    batch_ = dirty_.begin_batch();
    for (Worker& worker : workers_) {
      worker.changes.clear();
      worker.storage.clear();
      worker.visited = 0;
      worker.lowest = kTop;
    }
    cut_into_tasks(batch);
    team_.for_each(static_cast<std::int64_t>(tasks_.size()), 1, [&](ThreadTeam::Range range, int w) {
      for (std::int64_t i = range.begin; i < range.end; ++i) visit(tasks_[static_cast<std::size_t>(i)], w);
    });
    for (const std::int64_t unit : batch) dirty_.mark_seen(unit);
    commit_all();
    copy_all();
    std::int64_t visited = 0;
    for (const Worker& worker : workers_) {
      visited += worker.visited;
      lowest_ = std::min(lowest_, worker.lowest);
      changed_rows_ += static_cast<std::int64_t>(worker.changes.size());
      for (const Change& change : worker.changes) {
        dirty_.mark_unit_of(change.row);
        for_each_permuted(change.row, [this](std::int64_t permuted) {
          dirty_.mark_unit_of(permuted);
          ++permuted_count_;
        });
      }
    }
    if (memo_.is_on() && memo_.rows() > 1) {
      for (const std::int64_t unit : batch) {
        memo_.update(unit);
        for_each_permuted(unit * unit_rows_,
                          [this](std::int64_t permuted) { memo_.update(permuted / unit_rows_); });
      }
    }
    return visited;
  }

  /// RowSymmetry::for_each_permuted(), if there is a symmetry.
  template <class Visit>
  void for_each_permuted(std::int64_t row, const Visit& visit) const {
    if (symmetry_ != nullptr) symmetry_->for_each_permuted(row, visit);
  }

  /// The levels of a row have changed.
  void mark_changed(std::int64_t row) {
    dirty_.mark_row(row);
    dirty_.mark_unit_of(row);
    if (delta_) delta_->change(row, levels_.row(row));
  }

  /// A ghost row has changed.
  void hear_of(std::int64_t row) {
    mark_changed(row);
    if (memo_.is_on() && memo_.rows() > 1) memo_.update(row / unit_rows_);
  }

  void cut_into_tasks(const std::vector<std::int64_t>& batch) {
    tasks_.clear();
    copies_.clear();
    for (const std::int64_t unit : batch) {
      const std::int64_t end = std::min((unit + 1) * unit_rows_, own_.end);
      if (memo_.is_on() && memo_.rows() == 1) {
        choose_rows(unit, end);
        continue;
      }
      if (memo_.is_on()) {
        const std::int64_t other = memo_.find(RowPlace(engine_.grid(), unit * unit_rows_));
        if (other != unit) copies_.push_back({other, unit});
        if (other != unit) continue;
      }
      for (std::int64_t begin = std::max(unit * unit_rows_, own_.begin); begin < end; begin += kTaskRows) {
        tasks_.push_back({unit, begin, std::min(begin + kTaskRows, end)});
      }
    }
  }

  /// Tasks for the pending rows of a unit, or copies of rows on which the work was equal.
  void choose_rows(std::int64_t unit, std::int64_t end) {
    dirty_.enter(unit, scratch_);
    RowPlace place(engine_.grid(), unit * unit_rows_);
    for (; place.row < end; place.advance(engine_.grid())) {
      if (!is_to_be_looked_at(place, unit, scratch_)) continue;
      const std::int64_t other = memo_.find(place);
      if (other == place.row) {
        tasks_.push_back({unit, place.row, place.row + 1, true});
      } else {
        copies_.push_back({other, place.row});
      }
    }
  }

  [[nodiscard]] bool is_to_be_looked_at(const RowPlace& place, std::int64_t unit,
                                        DirtyRows::Scratch& scratch) const {
    if (!alive_.has(place.row)) return false;
    return dirty_.is_unseen(unit) || dirty_.meets_change(place, unit, scratch);
  }

  void visit(const Task& task, int w) {
    Worker& worker = workers_[static_cast<std::size_t>(w)];
    if (worker.batch != batch_ || worker.unit != task.unit) {
      worker.posts.enter(delta_ && !dirty_.is_unseen(task.unit) ? delta_->levels() : levels_);
      worker.batch = batch_;
      worker.unit = task.unit;
    }
    if (!task.is_wanted && !dirty_.is_unseen(task.unit)) dirty_.enter(task.unit, worker.dirty);
    RowPlace place(engine_.grid(), task.begin);
    for (; place.row < task.end; place.advance(engine_.grid())) {
      if (task.is_wanted || is_to_be_looked_at(place, task.unit, worker.dirty)) visit_row(place, worker, w);
    }
  }

  void visit_row(const RowPlace& place, Worker& worker, int w) {
    ++worker.visited;
    const auto n = static_cast<std::size_t>(levels_.row_length());
    std::copy_n(levels_.row(place.row), n, worker.old.begin());
    levels_.clear_gaps(worker.old.data());
    if (!op_.next_levels(place, worker.posts, worker.old.data(), worker.next.data(), w)) return;
    const LevelKernels<Level>& kernels = worker.posts.kernels();
    const bool is_changed =
        op_.rises() ? kernels.rise(worker.next.data(), worker.old.data(), worker.result.data(), n)
                    : kernels.advance(worker.next.data(), worker.old.data(), limit_, worker.result.data(), n);
    if (!is_changed) return;
    if (!op_.rises())
      worker.lowest =
          std::min(worker.lowest, kernels.lowest_change(worker.result.data(), worker.old.data(), n));
    const std::size_t position = worker.storage.size();
    worker.storage.resize(position + static_cast<std::size_t>(levels_.stride()));
    Level* const lanes = worker.storage.data() + position;
    std::copy_n(worker.result.begin(), n, lanes + levels_.margins().before);
    worker.changes.push_back({place.row, position, levels_.make_ready(lanes)});
  }

  /// @param is_together whether all processes are at this point now
  void tell(WaveStep& step, bool is_together) const {
    if (!watch_.step) return;
    const NumberRows state = rows_of(levels_);
    step.state = {&state, is_together ? std::size_t{1} : std::size_t{0}};
    watch_.step(step);
  }

  void commit_all() {
    std::size_t levels = 0;
    for (const Worker& worker : workers_) levels += worker.storage.size();
    if (levels < kFewLevels || levels_.is_interned()) {
      for (const Worker& worker : workers_) commit(worker);
      return;
    }
    team_.for_each(team_.size(), 1, [&](ThreadTeam::Range range, int) {
      for (std::int64_t w = range.begin; w < range.end; ++w) commit(workers_[static_cast<std::size_t>(w)]);
    });
  }

  void commit(const Worker& worker) {
    for (const Change& change : worker.changes) {
      const Level* const lanes = worker.storage.data() + change.position;
      const auto recall = [&](std::int64_t row) {
        if (delta_) delta_->change(row, levels_.row(row), lanes + levels_.margins().before);
      };
      recall(change.row);
      levels_.put_ready(change.row, lanes, change.ready);
      dirty_.mark_row(change.row);
      for_each_permuted(change.row, [&](std::int64_t permuted) {
        recall(permuted);
        static_cast<void>(levels_.copy_row(change.row, permuted));
        dirty_.mark_row(permuted);
      });
    }
  }

  void copy_all() {
    const auto mark = [this](std::int64_t row) {
      mark_changed(row);
      ++changed_rows_;
    };
    for (const Copy& copy : copies_) {
      memo_.copy(copy.from, copy.to, [&](std::int64_t row) {
        mark(row);
        for_each_permuted(row, [&](std::int64_t permuted) {
          if (levels_.copy_row(row, permuted)) mark(permuted);
          ++permuted_count_;
        });
      });
      copied_ += memo_.rows() == 1 ? 1 : alive_.of_unit(copy.to);
    }
  }

  LevelRows<Level>& levels_;
  const RowEngine& engine_;
  RowShare::Range own_;
  Level limit_;
  RowOperator<Level>& op_;
  const WaveWatch& watch_;
  ThreadTeam& team_;
  std::int64_t unit_rows_;
  DirtyRows dirty_;
  TileMemo<Level> memo_;
  std::optional<GhostExchange<Level>> ghosts_;  ///< of several processes
  std::optional<LevelDelta<Level>> delta_;      ///< where less is read so
  const RowSymmetry* symmetry_;                 ///< null: there is none
  AliveRows alive_;
  std::int64_t copied_ = 0;          ///< rows that would have been worked out
  std::int64_t permuted_count_ = 0;  ///< rows that are none of them, as they are not canonical
  std::int64_t first_unit_ = 0;
  std::int64_t units_ = 0;
  std::int64_t batch_units_ = 1;
  std::int64_t layer_ = -1;        ///< levels up to it are final
  std::int64_t changed_rows_ = 0;  ///< since the last sum
  Level lowest_ = kTop;            ///< to which a cell has sunk in this sweep
  std::uint32_t batch_ = 0;        ///< number of the last batch
  std::deque<Worker> workers_;
  std::vector<Task> tasks_;
  std::vector<Copy> copies_;
  DirtyRows::Scratch scratch_;
};

}  // namespace

template <class Level>
WaveCounts run_wave(LevelRows<Level>& levels, const RowEngine& engine, const RowHull& hull, Level limit,
                    RowOperator<Level>& op, const WaveWatch& watch, ThreadTeam& team,
                    const EqualWork& equal) {
  WaveRunner<Level> runner(levels, engine, hull, limit, op, watch, team, equal);
  WaveCounts counts;
  for (;;) {
    const std::int64_t visited = runner.sweep(++counts.sweeps);
    counts.rows_visited += visited;
    counts.rows_skipped += runner.alive_rows() - visited - (runner.copied_rows() - counts.rows_copied);
    counts.rows_copied = runner.copied_rows();
    if (!runner.goes_on(counts.sweeps, visited)) break;
  }
  counts.rows_copied += runner.permuted_rows();
  for (std::int64_t* rows : {&counts.rows_visited, &counts.rows_copied, &counts.rows_skipped})
    *rows = sum_of_all(engine.share(), *rows);
  return counts;
}

template WaveCounts run_wave(LevelRows<std::uint8_t>&, const RowEngine&, const RowHull&, std::uint8_t,
                             RowOperator<std::uint8_t>&, const WaveWatch&, ThreadTeam&, const EqualWork&);
template WaveCounts run_wave(LevelRows<std::uint16_t>&, const RowEngine&, const RowHull&, std::uint16_t,
                             RowOperator<std::uint16_t>&, const WaveWatch&, ThreadTeam&, const EqualWork&);
template WaveCounts run_wave(LevelRows<std::uint32_t>&, const RowEngine&, const RowHull&, std::uint32_t,
                             RowOperator<std::uint32_t>&, const WaveWatch&, ThreadTeam&, const EqualWork&);

}  // namespace coordreq
