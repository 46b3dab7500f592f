#include "answers/network/network_safety.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "answers/network/mode_sweep.hpp"
#include "answers/network/mode_targets.hpp"

namespace coordreq {
namespace {

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

/// Rows that have lost cells.
struct Losses {
  struct Row {
    std::size_t mode;
    std::int64_t row;
  };
  std::vector<Row> rows;
  std::vector<Word> cells;  ///< those left in each row
};

class SafetyIteration {
 public:
  SafetyIteration(const NetworkProblem& problem, const NetworkWatch& watch, ThreadTeam& team)
      : problem_(problem),
        engine_(*problem.controller->engine),
        watch_(watch),
        team_(team),
        choices_(problem, problem.resynthesise ? Agreement::careful : Agreement::none, team),
        targets_(engine_, problem.modes, *problem.invariant),
        sweep_(problem, choices_, targets_.levels(), team),
        losses_(static_cast<std::size_t>(team.size())) {
    if (watch.resumed != nullptr) resume(*watch.resumed);
  }

  /// Iterates in the order of successors_first(). @pre unchecked: the operators are monotone
  void run_in_any_order() {
    const std::vector<std::size_t> order = successors_first(problem_.modes);
    for (bool changed = true; changed || receives_changes();) {
      changed = false;
      for (const std::size_t mode : order) {
        while (targets_.has_changed(mode)) {
          sweep(mode);
          commit();
          report(engine_.share() == nullptr);
          changed = true;
        }
      }
    }
  }

  /// Iterates in rounds, each from the sets that the round before has left.
  void run_synchronously() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t mode = 0; mode < problem_.modes.size(); ++mode) {
        if (!targets_.has_changed(mode)) continue;
        sweep(mode);
        report(false);
        changed = true;
      }
      commit();
      report(true);
      if (engine_.share() != nullptr) changed = targets_.exchange();
    }
  }

  NetworkSafety result() { return {targets_.take_sets(), sweep_.counts()}; }

 private:
  void sweep(std::size_t mode) {
    targets_.load(mode, team_);
    const CellSet& set = targets_.set(mode);
    const auto has_changed = [&](std::int64_t row) { return targets_.is_changed(mode, row); };
    const PendingRows rows = pending_rows(problem_, set, targets_.is_untouched(mode), has_changed, team_);
    targets_.settle(mode);
    const auto keep = [&](std::int64_t row, const std::uint8_t* next, int w) {
      Losses& losses = losses_[static_cast<std::size_t>(w)];
      const std::size_t begin = losses.cells.size();
      losses.cells.resize(begin + engine_.row_words());
      Word* const cells = losses.cells.data() + begin;
      sweep_.kernels().top_bits(next, cells, static_cast<std::size_t>(engine_.row_length()));
      if (std::ranges::equal(set.row(row), std::span(losses.cells).subspan(begin))) {
        losses.cells.resize(begin);
      } else {
        losses.rows.push_back({mode, row});
      }
    };
    sweep_.run(mode, targets_.levels(), rows, set, keep);
  }

  void resume(std::vector<CellSet>& sets) {
    for (std::size_t mode = 0; mode < sets.size(); ++mode) {
      for (const RowShare::Range run : held_rows(engine_.share(), engine_.rows())) {
        for (std::int64_t row = run.begin; row < run.end; ++row)
          targets_.shrink(mode, row, sets[mode].row(row));
      }
      sets[mode] = {};
    }
  }

  bool receives_changes() {
    if (engine_.share() == nullptr) return false;
    report(true);
    return targets_.exchange();
  }

  /// @param whole whether work can be resumed from the sets, as those of all processes belong together
  void report(bool whole) const {
    sweep_.report(watch_.step, std::span<const CellSet>(targets_.sets()).first(whole ? targets_.modes() : 0));
  }

  void commit() {
    const std::size_t words = engine_.row_words();
    for (Losses& losses : losses_) {
      for (std::size_t i = 0; i < losses.rows.size(); ++i)
        targets_.shrink(losses.rows[i].mode, losses.rows[i].row,
                        ConstRow(losses.cells).subspan(i * words, words));
      losses.rows.clear();
      losses.cells.clear();
    }
  }

  const NetworkProblem& problem_;
  const RowEngine& engine_;
  const NetworkWatch& watch_;
  ThreadTeam& team_;
  ModeChoices choices_;
  ModeTargets targets_;
  ModeSweep<std::uint8_t> sweep_;
  std::vector<Losses> losses_;  ///< [worker] not committed yet
};

}  // namespace

NetworkSafety find_network_safety(const NetworkProblem& problem, const NetworkWatch& watch,
                                  ThreadTeam& team) {
  SafetyIteration iteration(problem, watch, team);
  problem.resynthesise ? iteration.run_synchronously() : iteration.run_in_any_order();
  return iteration.result();
}

}  // namespace coordreq
