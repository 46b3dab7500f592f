#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/row_engine.hpp"

namespace coordreq {

/// The levels of the cells that have changed in this sweep of a wave or in the one before, and kTop for all
/// others.
///
/// A row that may have to change is looked at in every sweep, so that by the last one it has taken in all
/// that had changed until then. A minimum over posts can become lower only by what has changed since, and
/// that is in here: the rest need not be read again. What is in here without need does no harm.
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

  /// What had changed before the last sweep does not count any more.
  void begin_sweep() {
    for (std::size_t r = 0; r < age_.size(); ++r) {
      if (age_[r] == Age::old) continue;
      forget(static_cast<std::int64_t>(r));
      age_[r] = age_[r] == Age::now ? Age::before : Age::old;
    }
  }

  /// A row gets other levels. Threads may tell of different rows.
  void change(std::int64_t row, const Level* before, const Level* after) {
    const auto words = now_.row(row);
    levels_.change_row(row, [&](Level* own) {
      for (std::int64_t c = 0; c < levels_.row_length(); ++c) {
        if (before[c] == after[c]) continue;
        own[c] = after[c];
        words[static_cast<std::size_t>(c / CellSet::kWordBits)] |= bit(c);
      }
    });
    age_[static_cast<std::size_t>(row)] = Age::now;
  }
  /// The same where nobody knows any more what they were: all of them count.
  void change(std::int64_t row, const Level* after) {
    levels_.put(row, after);
    for (std::int64_t c = 0; c < levels_.row_length(); ++c)
      now_.row(row)[static_cast<std::size_t>(c / CellSet::kWordBits)] |= bit(c);
    age_[static_cast<std::size_t>(row)] = Age::now;
  }

 private:
  enum class Age : std::uint8_t { old, before, now };

  static CellSet::Word bit(std::int64_t c) { return CellSet::Word{1} << (c % CellSet::kWordBits); }

  /// All but what has changed in this sweep.
  void forget(std::int64_t row) {
    const auto words = now_.row(row);
    levels_.change_row(row, [&](Level* own) {
      for (std::int64_t c = 0; c < levels_.row_length(); ++c) {
        if ((words[static_cast<std::size_t>(c / CellSet::kWordBits)] & bit(c)) == 0)
          own[c] = LevelRows<Level>::kTop;
      }
    });
    std::ranges::fill(words, CellSet::Word{0});
  }

  LevelRows<Level> levels_;
  CellSet now_;           ///< the cells that have changed in this sweep
  std::vector<Age> age_;  ///< [row] of its last change
};

}  // namespace coordreq
