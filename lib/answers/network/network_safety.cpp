#include "answers/network/network_safety.hpp"

#include <algorithm>
#include <deque>
#include <memory>
#include <utility>

#include "answers/network/careful_actions.hpp"
#include "answers/network/mode_targets.hpp"
#include "choices/independent_actions.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Level = std::uint8_t;

/// Rows that one thread takes at a time.
constexpr std::int64_t kTaskRows = 16;

/// One operator for each partition, with the objects to which it refers.
class Operators {
 public:
  Operators(const NetworkProblem& problem, ThreadTeam& team) {
    const Controller& controller = *problem.controller;
    const auto add = [&](const Projections& projections) {
      operators_.push_back(
          std::make_unique<IndependentActions<Level>>(projections, *controller.invariant, team.size()));
    };
    for (std::size_t p = 0; p < problem.partitions.size(); ++p) {
      if (problem.rules[p] != nullptr) {
        add(*problem.rules[p]);
        continue;
      }
      const ActionGrouping& grouping =
          groupings_.emplace_back(*controller.engine, problem.partitions[p], team);
      if (problem.resynthesise) {
        operators_.push_back(std::make_unique<CarefulActions>(grouping, team.size()));
        continue;
      }
      add(projections_.emplace_back(controller, grouping, team));
    }
  }

  [[nodiscard]] RowOperator<Level>& operator[](std::size_t partition) { return *operators_[partition]; }

 private:
  std::deque<ActionGrouping> groupings_;
  std::deque<Projections> projections_;
  std::vector<std::unique_ptr<RowOperator<Level>>> operators_;
};

/// Every mode after its successors, as far as there are no cycles: so losses travel backwards through many
/// modes in one round.
std::vector<std::size_t> successors_first(const std::vector<NetworkMode>& modes) {
  std::vector<std::size_t> order;
  std::vector<std::uint8_t> is_seen(modes.size(), 0);
  std::vector<std::pair<std::size_t, std::size_t>> path;  // (mode, number of its successors that are done)
  for (std::size_t root = 0; root < modes.size(); ++root) {
    if (is_seen[root] == 0) path.emplace_back(root, 0);
    is_seen[root] = 1;
    while (!path.empty()) {
      auto& [mode, done] = path.back();
      if (done == modes[mode].successors.size()) {
        order.push_back(mode);
        path.pop_back();
        continue;
      }
      const std::size_t next = modes[mode].successors[done++];
      if (is_seen[next] == 0) path.emplace_back(next, 0);
      is_seen[next] = 1;
    }
  }
  return order;
}

/// Rows of a mode that have lost cells.
struct Losses {
  std::size_t mode = 0;
  std::vector<std::int64_t> rows;
  std::vector<Word> cells;  ///< the cells left in each row
};

class SafetyIteration {
 public:
  SafetyIteration(const NetworkProblem& problem, const NetworkWatch& watch, ThreadTeam& team)
      : engine_(*problem.controller->engine),
        modes_(problem.modes),
        watch_(watch),
        team_(team),
        operators_(problem, team),
        over_(problem.over),
        targets_(engine_, *problem.hull, problem.modes, *problem.invariant) {
    for (int w = 0; w < team.size(); ++w) workers_.emplace_back(engine_, targets_.levels());
    if (watch.resumed != nullptr) resume(*watch.resumed);
  }

  /// Iterates in the order of successors_first(). @pre unchecked: the operators are monotone
  void run_in_any_order() {
    const std::vector<std::size_t> order = successors_first(modes_);
    for (bool changed = true; changed || hears_of_others();) {
      changed = false;
      for (const std::size_t mode : order) {
        while (targets_.has_changed(mode)) {
          commit(sweep(mode));
          tell(engine_.share() == nullptr);
          changed = true;
        }
      }
    }
  }

  /// Iterates in rounds, each from the sets that the round before has left.
  void run_synchronously() {
    for (bool changed = true; changed;) {
      std::vector<Losses> lost;
      for (std::size_t mode = 0; mode < modes_.size(); ++mode) {
        if (!targets_.has_changed(mode)) continue;
        lost.push_back(sweep(mode));
        tell(false);
      }
      for (const Losses& losses : lost) commit(losses);
      tell(true);
      changed = engine_.share() == nullptr ? !lost.empty() : targets_.exchange();
    }
  }

  NetworkSafety result() {
    counts_.rows_visited = sum_of_all(engine_.share(), counts_.rows_visited);
    counts_.rows_skipped = sum_of_all(engine_.share(), counts_.rows_skipped);
    counts_.sweeps =
        engine_.share() == nullptr ? counts_.sweeps : engine_.share()->ranks().greatest(counts_.sweeps);
    return {targets_.take_sets(), counts_};
  }

 private:
  struct Worker {
    Worker(const RowEngine& engine, const LevelRows<Level>& levels)
        : posts(engine, levels), old(posts.lanes(), 0), next(posts.lanes(), 0), cells(engine.row_words()) {}
    PostReader<Level> posts;
    std::vector<Level> old;
    std::vector<Level> next;
    std::vector<Word> cells;
    Losses losses;
  };

  Losses sweep(std::size_t mode) {
    targets_.load(mode, team_);
    std::int64_t alive = 0;
    const std::vector<std::int64_t> rows = targets_.take_pending(mode, alive, team_);
    const auto count = static_cast<std::int64_t>(rows.size());
    team_.for_each(count, kTaskRows, [&](ThreadTeam::Range range, int w) {
      Worker& worker = workers_[static_cast<std::size_t>(w)];
      std::int64_t unit = -1;
      for (std::int64_t i = range.begin; i < range.end; ++i) {
        const std::int64_t row = rows[static_cast<std::size_t>(i)];
        if (row / engine_.unit_rows() != unit) worker.posts.enter();
        unit = row / engine_.unit_rows();
        visit(mode, row, worker, w);
      }
    });
    ++counts_.sweeps;
    counts_.rows_visited += count;
    counts_.rows_skipped += alive - count;
    step_ = {.sweep = counts_.sweeps, .visited = count, .rows = alive};
    return collect(mode);
  }

  void resume(std::vector<CellSet>& sets) {
    for (std::size_t mode = 0; mode < modes_.size(); ++mode) {
      for (const RowShare::Range run : held_rows(engine_.share(), engine_.rows())) {
        for (std::int64_t row = run.begin; row < run.end; ++row)
          targets_.shrink(mode, row, sets[mode].row(row));
      }
      sets[mode] = {};
    }
  }

  bool hears_of_others() {
    if (engine_.share() == nullptr) return false;
    tell(true);
    return targets_.exchange();
  }

  /// @param whole whether work can be taken up from the sets, as those of all processes belong together
  void tell(bool whole) {
    if (!watch_.step) return;
    std::vector<NumberRows> sets;
    for (std::size_t mode = 0; whole && mode < modes_.size(); ++mode)
      sets.push_back(rows_of(targets_.set(mode)));
    step_.state = sets;
    watch_.step(step_);
  }

  void visit(std::size_t mode, std::int64_t row, Worker& worker, int w) {
    const LevelKernels<Level>& kernels = worker.posts.kernels();
    const auto n = static_cast<std::size_t>(engine_.row_length());
    const ConstRow present = targets_.set(mode).row(row);
    kernels.spread(present.data(), worker.old.data(), n);
    const ConstRow over = over_ == nullptr ? ConstRow() : over_->row(row);
    for_each_bit(over, [&worker](std::int64_t x) { worker.old[static_cast<std::size_t>(x)] = 0; });
    // Beyond the row there are no cells.
    std::fill(worker.old.begin() + static_cast<std::ptrdiff_t>(n), worker.old.end(), Level{0});
    RowOperator<Level>& op = operators_[modes_[mode].partition];
    const RowPlace place(engine_.grid(), row);
    if (!op.next_levels(place, worker.posts, worker.old.data(), worker.next.data(), w)) return;
    kernels.top_bits(worker.next.data(), worker.cells.data(), n);
    for (std::size_t k = 0; k < over.size(); ++k) worker.cells[k] |= over[k];
    for (std::size_t k = 0; k < worker.cells.size(); ++k) worker.cells[k] &= present[k];
    if (std::equal(present.begin(), present.end(), worker.cells.begin())) return;
    worker.losses.rows.push_back(row);
    worker.losses.cells.insert(worker.losses.cells.end(), worker.cells.begin(), worker.cells.end());
  }

  Losses collect(std::size_t mode) {
    Losses all{.mode = mode, .rows = {}, .cells = {}};
    for (Worker& worker : workers_) {
      all.rows.insert(all.rows.end(), worker.losses.rows.begin(), worker.losses.rows.end());
      all.cells.insert(all.cells.end(), worker.losses.cells.begin(), worker.losses.cells.end());
      worker.losses.rows.clear();
      worker.losses.cells.clear();
    }
    return all;
  }

  void commit(const Losses& losses) {
    const std::size_t words = engine_.row_words();
    for (std::size_t i = 0; i < losses.rows.size(); ++i)
      targets_.shrink(losses.mode, losses.rows[i], ConstRow(losses.cells).subspan(i * words, words));
  }

  const RowEngine& engine_;
  const std::vector<NetworkMode>& modes_;
  const NetworkWatch& watch_;
  WaveStep step_;
  ThreadTeam& team_;
  Operators operators_;
  const CellSet* over_;  ///< cells whose posts are not looked at; null: none
  ModeTargets targets_;
  std::deque<Worker> workers_;
  WaveCounts counts_;
};

}  // namespace

NetworkSafety find_network_safety(const NetworkProblem& problem, const NetworkWatch& watch,
                                  ThreadTeam& team) {
  SafetyIteration iteration(problem, watch, team);
  problem.resynthesise ? iteration.run_synchronously() : iteration.run_in_any_order();
  return iteration.result();
}

}  // namespace coordreq
