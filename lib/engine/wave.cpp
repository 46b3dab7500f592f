#include "engine/wave.hpp"

#include <algorithm>
#include <deque>
#include <vector>

#include "engine/row_box.hpp"

namespace coordreq {
namespace {

/// Rows of a batch, if units are not larger: so few that most rows see what was found just before (on the
/// intersection of the paper 31 instead of 3,000 rows take a tenth of the visits), enough for some threads.
constexpr std::int64_t kBatchRows = 32;
/// Rows to a unit of work where the engine's units are too large to be one.
constexpr std::int64_t kBlockRows = 32;
/// Rows that one thread takes at a time.
constexpr std::int64_t kPieceRows = 8;
/// Below this many levels, handing out the copying costs more than doing it.
constexpr std::size_t kFewLevels = std::size_t{1} << 18;

template <class Level>
class WaveRunner {
 public:
  WaveRunner(LevelRows<Level>& levels, const RowEngine& engine, const RowHull& hull, Level limit,
             const std::vector<std::uint8_t>& settled, RowOperator<Level>& op, const WaveWatch& watch,
             ThreadTeam& team)
      : levels_(levels),
        engine_(engine),
        hull_(hull),
        limit_(limit),
        settled_(settled),
        op_(op),
        watch_(watch),
        team_(team) {
    unit_rows_ = std::min(engine.unit_rows(), engine.outer() == 0 ? kBlockRows : engine.unit_rows());
    units_ = (engine.rows() + unit_rows_ - 1) / unit_rows_;
    batch_units_ = std::max<std::int64_t>(1, kBatchRows / unit_rows_);
    changed_.assign(static_cast<std::size_t>(engine.rows()), 0);
    unit_changed_.assign(static_cast<std::size_t>(units_), 0);
    unit_seen_.assign(static_cast<std::size_t>(units_), kBeforeAll);
    for (int w = 0; w < team.size(); ++w) workers_.emplace_back(engine, levels);
    find_alive();
  }

  /// @returns rows visited
  std::int64_t sweep(std::int64_t number) {
    const bool backwards = number % 2 == 1;
    WaveStep step{.sweep = number, .rows_left = alive_rows_, .rows = alive_rows_, .layer = layer_};
    lowest_ = kTop;
    std::vector<std::int64_t> batch;
    for (std::int64_t k = 0; k < units_; ++k) {
      const std::int64_t unit = backwards ? units_ - 1 - k : k;
      step.rows_left -= unit_alive_[static_cast<std::size_t>(unit)];
      if (is_pending(unit)) batch.push_back(unit);
      if (batch.empty() || (static_cast<std::int64_t>(batch.size()) < batch_units_ && k + 1 < units_))
        continue;
      step.visited += run(batch);
      batch.clear();
      tell(step);
    }
    // Levels below the lowest to which a cell has sunk in a whole sweep are final: the sets they make have
    // not changed while it was found of each cell that it stays in them.
    layer_ = std::max<std::int64_t>(layer_, lowest_ == kTop ? layer_ : std::int64_t{lowest_} - 1);
    step.layer = layer_;
    tell(step);
    return step.visited;
  }

  [[nodiscard]] std::int64_t alive_rows() const { return alive_rows_; }

 private:
  static constexpr Level kTop = LevelRows<Level>::kTop;
  /// As what a unit has been looked at in: in no batch, or in one whose changes, and all after, are news to
  /// it.
  static constexpr std::uint32_t kNever = 0;
  static constexpr std::uint32_t kBeforeAll = 1;

  struct Change {
    std::int64_t row;
    std::size_t position;  ///< in the worker's storage
  };
  /// Rows of one unit that one thread looks at.
  struct Piece {
    std::int64_t unit;
    std::int64_t begin;
    std::int64_t end;
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
    std::vector<std::uint32_t> merged;
    std::vector<std::int64_t> counter;
    RowHull::Box box;
    std::int64_t visited = 0;
    Level lowest = kTop;      ///< to which a cell has sunk
    std::uint32_t batch = 0;  ///< and unit: what the reader has entered
    std::int64_t unit = -1;
  };

  [[nodiscard]] bool is_settled(std::int64_t row) const {
    return !settled_.empty() && settled_[static_cast<std::size_t>(row)] != 0;
  }

  /// Rows without a cell in the set never change, nor do those that have sunk as deep as cells in the set
  /// can.
  void find_alive() {
    alive_.assign(static_cast<std::size_t>(engine_.rows()), 0);
    unit_alive_.assign(static_cast<std::size_t>(units_), 0);
    for (std::int64_t r = 0; r < engine_.rows(); ++r) {
      bool alive = false;
      levels_.shape().for_each_run([&](std::int64_t lane, std::int64_t count) {
        const Level* cells = levels_.row(r) + lane;
        alive = alive || std::any_of(cells, cells + count, [](Level level) { return level > 1; });
      });
      alive_[static_cast<std::size_t>(r)] = alive ? 1 : 0;
      if (!alive) continue;
      const auto unit = static_cast<std::size_t>(r / unit_rows_);
      ++unit_alive_[unit];
      if (!is_settled(r)) unit_seen_[unit] = kNever;
      ++alive_rows_;
    }
  }

  /// True if a unit that posts of this one can meet has changed since this one was last looked at.
  [[nodiscard]] bool is_pending(std::int64_t unit) {
    const auto u = static_cast<std::size_t>(unit);
    if (unit_alive_[u] == 0) return false;
    if (unit_seen_[u] == kNever || engine_.outer() == 0)
      return unit_seen_[u] == kNever || last_change_ >= unit_seen_[u];
    const RowPlace place(engine_.grid(), unit * unit_rows_);
    hull_.box(place, box_);
    const std::span<const IndexRange> outer(box_.ranges.data(), engine_.outer());
    bool pending = false;
    for_each_row(engine_, 0, outer, counter_, [&](std::int64_t row) {
      pending = pending || unit_changed_[static_cast<std::size_t>(row / unit_rows_)] >= unit_seen_[u];
    });
    return pending;
  }

  std::int64_t run(const std::vector<std::int64_t>& batch) {
    ++batch_;
    for (Worker& worker : workers_) {
      worker.changes.clear();
      worker.storage.clear();
      worker.visited = 0;
      worker.lowest = kTop;
    }
    cut_into_pieces(batch);
    team_.for_each(static_cast<std::int64_t>(pieces_.size()), 1, [&](ThreadTeam::Range range, int w) {
      for (std::int64_t i = range.begin; i < range.end; ++i) visit(pieces_[static_cast<std::size_t>(i)], w);
    });
    for (const std::int64_t unit : batch) unit_seen_[static_cast<std::size_t>(unit)] = batch_;
    commit_all();
    std::int64_t visited = 0;
    for (const Worker& worker : workers_) {
      visited += worker.visited;
      lowest_ = std::min(lowest_, worker.lowest);
      for (const Change& change : worker.changes) {
        unit_changed_[static_cast<std::size_t>(change.row / unit_rows_)] = batch_;
        last_change_ = batch_;
      }
    }
    return visited;
  }

  void cut_into_pieces(const std::vector<std::int64_t>& batch) {
    pieces_.clear();
    for (const std::int64_t unit : batch) {
      const std::int64_t end = std::min((unit + 1) * unit_rows_, engine_.rows());
      for (std::int64_t begin = unit * unit_rows_; begin < end; begin += kPieceRows) {
        pieces_.push_back({unit, begin, std::min(begin + kPieceRows, end)});
      }
    }
  }

  void visit(const Piece& piece, int w) {
    Worker& worker = workers_[static_cast<std::size_t>(w)];
    if (worker.batch != batch_ || worker.unit != piece.unit) {
      worker.posts.enter();
      worker.batch = batch_;
      worker.unit = piece.unit;
    }
    const std::uint32_t seen = unit_seen_[static_cast<std::size_t>(piece.unit)];
    const bool is_first = seen == kNever;
    if (!is_first || !settled_.empty()) merge_changes(piece.unit * unit_rows_, worker);
    RowPlace place(engine_.grid(), piece.begin);
    for (; place.row < piece.end; place.advance(engine_.grid())) {
      if (alive_[static_cast<std::size_t>(place.row)] == 0) continue;
      const bool is_new = is_first && !is_settled(place.row);
      if (is_new || meets_change(place, std::max(seen, kBeforeAll), worker)) visit_row(place, worker, w);
    }
  }

  /// For the rows of a unit: when last a row changed that they can meet in the shared dimensions.
  void merge_changes(std::int64_t first_row, Worker& worker) {
    if (engine_.outer() == 0) return;
    hull_.box(RowPlace(engine_.grid(), first_row), worker.box);
    worker.merged.assign(static_cast<std::size_t>(unit_rows_), 0);
    const std::span<const IndexRange> outer(worker.box.ranges.data(), engine_.outer());
    for_each_row(engine_, 0, outer, worker.counter, [&](std::int64_t row) {
      const std::uint32_t* changed = changed_.data() + row;
      for (std::size_t i = 0; i < worker.merged.size(); ++i) {
        worker.merged[i] = std::max(worker.merged[i], changed[i]);
      }
    });
  }

  [[nodiscard]] bool meets_change(const RowPlace& place, std::uint32_t seen, Worker& worker) {
    hull_.box(place, worker.box);
    const std::size_t outer = engine_.outer();
    const std::span<const IndexRange> inner(worker.box.ranges.data() + outer,
                                            worker.box.ranges.size() - outer);
    const std::uint32_t* changed = outer == 0 ? changed_.data() : worker.merged.data();
    bool meets = false;
    for_each_row(engine_, outer, inner, worker.counter,
                 [&](std::int64_t row) { meets = meets || changed[row] >= seen; });
    return meets;
  }

  void visit_row(const RowPlace& place, Worker& worker, int w) {
    ++worker.visited;
    const auto n = static_cast<std::size_t>(levels_.row_length());
    const Level* present = levels_.row(place.row);
    std::copy_n(present, n, worker.old.begin());
    levels_.clear_gaps(worker.old.data());
    if (!op_.next_levels(place, worker.posts, worker.old.data(), worker.next.data(), w)) return;
    const LevelKernels<Level>& kernels = worker.posts.kernels();
    if (!kernels.advance(worker.next.data(), worker.old.data(), limit_, worker.result.data(), n)) return;
    Level lowest = worker.lowest;
    for (std::size_t c = 0; c < n; ++c) {
      const Level sunk = worker.result[c] == worker.old[c] ? kTop : worker.result[c];
      lowest = std::min(lowest, sunk);
    }
    worker.lowest = lowest;
    worker.changes.push_back({place.row, worker.storage.size()});
    worker.storage.insert(worker.storage.end(), worker.result.begin(),
                          worker.result.begin() + static_cast<std::ptrdiff_t>(n));
  }

  void tell(WaveStep& step) const {
    if (!watch_.step) return;
    const NumberRows state = rows_of(levels_);
    step.state = {&state, 1};
    watch_.step(step);
  }

  void commit_all() {
    std::size_t levels = 0;
    for (const Worker& worker : workers_) levels += worker.storage.size();
    if (levels < kFewLevels) {
      for (const Worker& worker : workers_) commit(worker);
      return;
    }
    team_.for_each(team_.size(), 1, [&](ThreadTeam::Range range, int) {
      for (std::int64_t w = range.begin; w < range.end; ++w) commit(workers_[static_cast<std::size_t>(w)]);
    });
  }

  void commit(const Worker& worker) {
    for (const Change& change : worker.changes) {
      std::copy_n(worker.storage.data() + change.position, levels_.row_length(), levels_.row(change.row));
      levels_.close(change.row);
      changed_[static_cast<std::size_t>(change.row)] = batch_;
    }
  }

  LevelRows<Level>& levels_;
  const RowEngine& engine_;
  const RowHull& hull_;
  Level limit_;
  const std::vector<std::uint8_t>& settled_;
  RowOperator<Level>& op_;
  const WaveWatch& watch_;
  ThreadTeam& team_;
  std::int64_t unit_rows_ = 1;
  std::int64_t units_ = 0;
  std::int64_t batch_units_ = 1;
  std::int64_t alive_rows_ = 0;
  std::int64_t layer_ = -1;                  ///< levels up to it are final
  Level lowest_ = kTop;                      ///< to which a cell has sunk in this sweep
  std::uint32_t batch_ = 0;                  ///< number of the last batch
  std::uint32_t last_change_ = 0;            ///< the last batch with a change
  std::vector<std::uint32_t> changed_;       ///< [row] the batch that changed it last
  std::vector<std::uint32_t> unit_changed_;  ///< [unit] likewise
  std::vector<std::uint32_t> unit_seen_;     ///< [unit] the batch that looked at it last
  std::vector<std::uint8_t> alive_;
  std::vector<std::int64_t> unit_alive_;  ///< [unit] rows that are alive
  std::deque<Worker> workers_;
  std::vector<Piece> pieces_;
  RowHull::Box box_;
  std::vector<std::int64_t> counter_;
};

}  // namespace

template <class Level>
WaveCounts run_wave(LevelRows<Level>& levels, const RowEngine& engine, const RowHull& hull, Level limit,
                    const std::vector<std::uint8_t>& settled, RowOperator<Level>& op, const WaveWatch& watch,
                    ThreadTeam& team) {
  WaveRunner<Level> runner(levels, engine, hull, limit, settled, op, watch, team);
  WaveCounts counts;
  for (;;) {
    const std::int64_t visited = runner.sweep(++counts.sweeps);
    counts.rows_visited += visited;
    counts.rows_skipped += runner.alive_rows() - visited;
    if (visited == 0) return counts;
  }
}

template WaveCounts run_wave(LevelRows<std::uint8_t>&, const RowEngine&, const RowHull&, std::uint8_t,
                             const std::vector<std::uint8_t>&, RowOperator<std::uint8_t>&, const WaveWatch&,
                             ThreadTeam&);
template WaveCounts run_wave(LevelRows<std::uint16_t>&, const RowEngine&, const RowHull&, std::uint16_t,
                             const std::vector<std::uint8_t>&, RowOperator<std::uint16_t>&, const WaveWatch&,
                             ThreadTeam&);
template WaveCounts run_wave(LevelRows<std::uint32_t>&, const RowEngine&, const RowHull&, std::uint32_t,
                             const std::vector<std::uint8_t>&, RowOperator<std::uint32_t>&, const WaveWatch&,
                             ThreadTeam&);

}  // namespace coordreq
