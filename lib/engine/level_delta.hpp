#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/row_engine.hpp"

namespace coordreq {

/// The delta of the levels of a wave: the level of each cell that has changed in this sweep or in the one
/// before, and kTop for all other cells.
///
/// A row is visited in each sweep in which it is pending, so that by the last one it has taken in all changes
/// before. Since then a minimum over its posts can have become lower only by cells that have changed since,
/// and these are in the delta: an operator that is a minimum may read the delta instead of the levels. A cell
/// that is in the delta without need has its level there, which does no harm.
///
/// Why: where rows are added up, most bounds over the delta are kTop, and say at once that no level sinks.
/// With choices of a class added up together it took a large aircraft from 0.71 - 0.74 to 0.55 - 0.60 of the
/// time of an earlier version. The switch is FastPaths::level_delta.
///
/// Threads: several may call change() for different rows; no thread reads meanwhile.
template <class Level>
class LevelDelta {
 public:
  LevelDelta(const RowEngine& engine, ThreadTeam& team)
      : levels_(engine.make_levels<Level>(engine.posts())),
        now_(engine.rows(), engine.row_length()),
        age_(static_cast<std::size_t>(engine.rows()), Age::old) {
    for_each_held_row(team, engine.share(), engine.rows(), 256, [&](ThreadTeam::Range range, int) {
      for (std::int64_t row = range.begin; row < range.end; ++row) forget(row);
    });
  }

  [[nodiscard]] const LevelRows<Level>& levels() const { return levels_; }

  /// Begins a sweep: cells that changed last before the sweep that has ended become kTop.
  void begin_sweep(ThreadTeam& team) {
    team.for_each(std::ssize(age_), 256, [&](ThreadTeam::Range range, int) {
      for (std::int64_t row = range.begin; row < range.end; ++row) {
        Age& age = age_[static_cast<std::size_t>(row)];
        if (age == Age::old) continue;
        forget(row);
        age = age == Age::now ? Age::before : Age::old;
      }
    });
  }

  /// The levels of a row change. @param before, after its cells
  void change(std::int64_t row, const Level* before, const Level* after) {
    const auto words = now_.row(row);
    levels_.change_row(row, [&](Level* cells) {
      for (std::int64_t c = 0; c < levels_.row_length(); ++c) {
        if (before[c] == after[c]) continue;
        cells[c] = after[c];
        words[static_cast<std::size_t>(c / CellSet::kWordBits)] |= bit(c);
      }
    });
    age_[static_cast<std::size_t>(row)] = Age::now;
  }
  /// change() where the levels before are not known: all cells count as changed.
  void change(std::int64_t row, const Level* after) {
    levels_.put(row, after);
    for (std::int64_t c = 0; c < levels_.row_length(); ++c)
      now_.row(row)[static_cast<std::size_t>(c / CellSet::kWordBits)] |= bit(c);
    age_[static_cast<std::size_t>(row)] = Age::now;
  }

 private:
  enum class Age : std::uint8_t { old, before, now };

  static CellSet::Word bit(std::int64_t c) { return CellSet::Word{1} << (c % CellSet::kWordBits); }

  /// Makes the cells of a row kTop that have not changed in this sweep, and begins anew to note changes.
  void forget(std::int64_t row) {
    const auto words = now_.row(row);
    levels_.change_row(row, [&](Level* cells) {
      for (std::int64_t c = 0; c < levels_.row_length(); ++c) {
        if ((words[static_cast<std::size_t>(c / CellSet::kWordBits)] & bit(c)) == 0)
          cells[c] = LevelRows<Level>::kTop;
      }
    });
    std::ranges::fill(words, CellSet::Word{0});
  }

  LevelRows<Level> levels_;
  CellSet now_;           ///< the cells that have changed in this sweep
  std::vector<Age> age_;  ///< [row] of its last change
};

}  // namespace coordreq
