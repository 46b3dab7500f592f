#include <algorithm>
#include <atomic>
#include <deque>
#include <span>

#include "answers/blind/class_rows.hpp"
#include "answers/blind/silent_table.hpp"
#include "base/index.hpp"
#include "engine/row_engine.hpp"

namespace coordreq {
namespace {

/// The most counts, of all actions in a batch of fibres, that are held at once.
constexpr std::int64_t kMostCounts = std::int64_t{1} << 22;

constexpr std::int32_t kWhole = -1;  ///< marks a fibre that keeps all of its cells, or is not in the batch

/// Removes cells from a set, for one class after the other.
class CellRemoval {
 public:
  CellRemoval(const SilentSources& sources, const std::vector<SilentTable>& tables, ThreadTeam& team,
              CellSet& left)
      : sources_(sources), tables_(tables), team_(team), left_(left) {
    for (int w = 0; w < team.size(); ++w) workers_.push_back({.rows = ClassRows(sources)});
  }

  /// Fibres with a common action keep all cells; in the fibres `conflicting` cells without the most common
  /// action are removed.
  void remove(std::size_t c, const std::vector<std::int64_t>& conflicting) {
    const SilentTable& table = tables_[c];
    const auto at_once = std::max<std::int64_t>(1, kMostCounts / table.actions);
    for (std::int64_t begin = 0; begin < std::ssize(conflicting); begin += at_once) {
      const std::int64_t end = std::min(std::ssize(conflicting), begin + at_once);
      positions_.assign(table.seen_depth.size(), kWhole);
      for (std::int64_t i = begin; i < end; ++i)
        positions_[at(conflicting[at(i)])] = static_cast<std::int32_t>(i - begin);
      const std::vector<std::int64_t> counts = count_actions(c, end - begin);
      remove_others(c, most_counted(counts, table.actions));
    }
  }

 private:
  struct Worker {
    ClassRows rows;
    std::vector<Word> cells = {};  ///< of the row, in fibres of the batch
    std::vector<Word> have = {};   ///< of these, the cells with an action
  };

  /// Calls `visit(position, worker)` for rows that have cells in the batch.
  template <class Visit>
  void for_each_row_of_batch(std::size_t c, const Visit& visit) {
    const RowEngine& engine = sources_.projections.grouping().engine();
    const Fibres& fibres = *sources_.fibres[c];
    for_each_local_row(team_, engine.share(), engine.rows(), 64, [&](ThreadTeam::Range range, int number) {
      Worker& worker = workers_[at(number)];
      for (RowPosition position(engine.grid(), range.begin); position.row < range.end;
           position.advance(engine.grid())) {
        worker.cells.assign(engine.row_words(), 0);
        const std::int64_t base = fibres.base(position);
        for_each_bit(left_.row(position.row), [&](std::int64_t x) {
          if (positions_[at(base + fibres.of_lane(x))] != kWhole)
            worker.cells[at(x / CellSet::kWordBits)] |= Word{1} << (x % CellSet::kWordBits);
        });
        if (!any_set(worker.cells)) continue;
        worker.rows.enter(position);
        visit(position, worker);
      }
    });
  }

  /// Calls `visit(position of the fibre in the batch, action, lane)` for the actions of each cell of the row.
  template <class Visit>
  void for_each_action(std::size_t c, const RowPosition& position, Worker& worker, const Visit& visit) {
    const Fibres& fibres = *sources_.fibres[c];
    const std::int64_t base = fibres.base(position);
    for (std::int64_t a = 0; a < tables_[c].actions; ++a) {
      const ConstRow all = worker.rows.cells(c, static_cast<std::uint32_t>(a));
      worker.have.resize(all.size());
      for (std::size_t w = 0; w < all.size(); ++w) worker.have[w] = all[w] & worker.cells[w];
      for_each_bit(worker.have,
                   [&](std::int64_t x) { visit(positions_[at(base + fibres.of_lane(x))], a, x); });
    }
  }

  /// [position of the fibre * actions + a] cells of the fibre that have the action, of all processes.
  std::vector<std::int64_t> count_actions(std::size_t c, std::int64_t fibres) {
    const std::int64_t actions = tables_[c].actions;
    std::vector<std::int64_t> counts(at(fibres * actions), 0);
    for_each_row_of_batch(c, [&](const RowPosition& position, Worker& worker) {
      for_each_action(c, position, worker, [&](std::int32_t fibre, std::int64_t a, std::int64_t /*lane*/) {
        std::atomic_ref<std::int64_t>(counts[at(fibre * actions + a)])
            .fetch_add(1, std::memory_order_relaxed);
      });
    });
    const RowShare* const share = left_share();
    if (share != nullptr) share->ranks().add(counts);
    return counts;
  }

  /// [position of the fibre] the action that most cells have, the lowest of equals.
  static std::vector<std::int64_t> most_counted(const std::vector<std::int64_t>& counts,
                                                std::int64_t actions) {
    std::vector<std::int64_t> most;
    for (auto first = counts.begin(); first != counts.end(); first += static_cast<std::ptrdiff_t>(actions))
      most.push_back(std::max_element(first, first + static_cast<std::ptrdiff_t>(actions)) - first);
    return most;
  }

  void remove_others(std::size_t c, const std::vector<std::int64_t>& chosen) {
    for_each_row_of_batch(c, [&](const RowPosition& position, Worker& worker) {
      std::vector<Word> lost = worker.cells;
      for_each_action(c, position, worker, [&](std::int32_t fibre, std::int64_t a, std::int64_t lane) {
        if (a == chosen[at(fibre)])
          lost[at(lane / CellSet::kWordBits)] &= ~(Word{1} << (lane % CellSet::kWordBits));
      });
      const MutableRow left = left_.row(position.row);
      for (std::size_t w = 0; w < lost.size(); ++w) left[w] &= ~lost[w];
    });
  }

  [[nodiscard]] const RowShare* left_share() const {
    return sources_.projections.grouping().engine().share();
  }

  const SilentSources& sources_;
  const std::vector<SilentTable>& tables_;
  ThreadTeam& team_;
  CellSet& left_;
  std::vector<Worker> workers_;
  std::vector<std::int32_t> positions_;  ///< [fibre] position in the batch, or kWhole
};

/// Z_1, in own rows.
CellSet second_layer(const LevelMap& layers, const CellSet& invariant) {
  CellSet result(invariant.rows(), invariant.row_length());
  layers.visit([&](const auto& levels) {
    const RowShare::Range local = local_rows(levels.share(), levels.rows());
    for (std::int64_t r = local.begin; r < local.end; ++r) {
      const auto* const row = levels.row(r);
      for_each_bit(invariant.row(r), [&](std::int64_t x) {
        if (row[x] > 1) result.row(r)[at(x / CellSet::kWordBits)] |= Word{1} << (x % CellSet::kWordBits);
      });
    }
  });
  return result;
}

}  // namespace

std::optional<CellSet> find_common_cells(const SilentSources& sources, const LevelMap& layers,
                                         const std::vector<SilentTable>& tables, ThreadTeam& team) {
  std::optional<CellSet> left;
  for (std::size_t c = 0; c < tables.size(); ++c) {
    // Removing cells for classes before this one can only mend a fibre; its counts show whether it has.
    std::vector<std::int64_t> conflicting;
    for (std::int64_t fibre = 0; fibre < tables[c].fibres(); ++fibre) {
      if (tables[c].has_conflict(fibre)) conflicting.push_back(fibre);
    }
    if (conflicting.empty()) continue;
    if (!left) left = second_layer(layers, sources.invariant);
    CellRemoval(sources, tables, team, *left).remove(c, conflicting);
  }
  return left;
}

}  // namespace coordreq
