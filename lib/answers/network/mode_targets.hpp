#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "answers/network/network_problem.hpp"
#include "base/thread_team.hpp"
#include "engine/row_engine.hpp"

namespace coordreq {

/// The sets W(q) of all modes while they shrink, and the target T(q) of one mode at a time, the intersection
/// of W(q') over the modes q' that follow q: as levels, kTop for members and 0 for other cells.
///
/// Remembers for each mode the rows in which its target has changed since settle() was last called.
class ModeTargets {
 public:
  /// All W(q) are `start`, and all rows are pending.
  ModeTargets(const RowEngine& engine, const std::vector<NetworkMode>& modes, const CellSet& start);

  [[nodiscard]] std::size_t modes() const { return sets_.size(); }
  [[nodiscard]] const CellSet& set(std::size_t mode) const { return sets_[mode]; }
  [[nodiscard]] const std::vector<CellSet>& sets() const { return sets_; }
  [[nodiscard]] std::vector<CellSet> take_sets() { return std::move(sets_); }

  /// Brings ghost rows up to date: rows of other processes that have changed since this was called last.
  /// Together. @returns whether rows of any process have changed
  bool exchange();

  /// Whether some row held of the target of a mode has changed.
  [[nodiscard]] bool has_changed(std::size_t mode) const { return state_[mode] != State::settled; }
  /// Makes levels() those of this mode's target.
  void load(std::size_t mode, ThreadTeam& team);
  [[nodiscard]] const LevelRows<std::uint8_t>& levels() const { return levels_; }
  /// No row of the target of a mode has been settled yet.
  [[nodiscard]] bool is_untouched(std::size_t mode) const { return state_[mode] == State::untouched; }
  /// Whether a row of the target of a mode has changed since settle().
  [[nodiscard]] bool is_changed(std::size_t mode, std::int64_t row) const {
    return (changed_[mode][static_cast<std::size_t>(row / 64)] >> (row % 64) & 1U) != 0;
  }
  /// From now on no row counts as changed for this mode.
  void settle(std::size_t mode);
  /// Replaces a row of W(mode).
  void shrink(std::size_t mode, std::int64_t row, ConstRow cells);

 private:
  enum class State : std::uint8_t { untouched, changed, settled };

  void replace(std::size_t mode, std::int64_t row, ConstRow cells);
  void load_row(std::size_t mode, std::int64_t row, std::vector<Word>& cells,
                std::vector<std::uint8_t>& lanes);

  const RowEngine& engine_;
  const std::vector<NetworkMode>& modes_;
  std::vector<std::vector<std::size_t>> predecessors_;
  std::vector<CellSet> sets_;
  std::vector<State> state_;
  std::vector<std::vector<Word>> changed_;  ///< [mode] one bit for each row of its target
  std::vector<std::vector<Word>>
      unsent_;  ///< [mode] one bit for each row of W(mode) that was not sent to other processes
  LevelRows<std::uint8_t> levels_;
  std::size_t loaded_;
};

}  // namespace coordreq
