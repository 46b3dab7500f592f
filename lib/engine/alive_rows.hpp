#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "base/thread_team.hpp"
#include "base/zeroed_array.hpp"
#include "engine/level_rows.hpp"
#include "engine/row_symmetry.hpp"

namespace coordreq {

/// The rows that a wave has to look at. Rows without a cell in the set never change, nor do rows that have
/// sunk as deep (risen as high) as cells in the set can; of permuted rows the canonical one is enough.
class AliveRows {
 public:
  /// @param local the rows to choose from
  /// @param unit_rows rows of a unit: alive rows are counted by unit
  /// @param symmetry may be null
  template <class Level>
  AliveRows(const LevelRows<Level>& levels, RowShare::Range local, std::int64_t unit_rows, bool rises,
            const RowSymmetry* symmetry, ThreadTeam& team)
      : is_alive_(static_cast<std::size_t>(levels.rows())),
        of_unit_(static_cast<std::size_t>((local.end + unit_rows - 1) / unit_rows), 0) {
    const std::int64_t first = local.begin / unit_rows;
    const std::int64_t units = std::ssize(of_unit_) - first;
    std::vector<std::int64_t> counts(static_cast<std::size_t>(team.size()), 0);
    team.for_each(units, 256, [&](ThreadTeam::Range range, int w) {
      const std::int64_t begin = std::max(local.begin, (first + range.begin) * unit_rows);
      const std::int64_t end = std::min(local.end, (first + range.end) * unit_rows);
      const Level* before = nullptr;  // rows that are held once often follow one another
      bool can = false;
      for (std::int64_t r = begin; r < end; ++r) {
        const Level* const row = levels.row(r);
        if (row != before) can = can_change(levels, row, rises);
        before = row;
        if (!can || (symmetry != nullptr && !symmetry->is_canonical(r))) continue;
        is_alive_[static_cast<std::size_t>(r)] = 1;
        ++of_unit_[static_cast<std::size_t>(r / unit_rows)];
        ++counts[static_cast<std::size_t>(w)];
      }
    });
    count_ = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  }

  [[nodiscard]] bool has(std::int64_t row) const { return is_alive_[static_cast<std::size_t>(row)] != 0; }
  [[nodiscard]] std::int64_t of_unit(std::int64_t unit) const {
    return of_unit_[static_cast<std::size_t>(unit)];
  }
  [[nodiscard]] std::int64_t count() const { return count_; }

 private:
  template <class Level>
  [[nodiscard]] static bool can_change(const LevelRows<Level>& levels, const Level* row, bool rises) {
    const auto is_open = [rises](Level level) {
      return rises ? level > 0 && level < LevelRows<Level>::kTop : level > 1;
    };
    bool can = false;
    levels.shape().for_each_run([&](std::int64_t lane, std::int64_t count) {
      can = can || std::any_of(row + lane, row + lane + count, is_open);
    });
    return can;
  }

  ZeroedArray<std::uint8_t> is_alive_;  ///< [row]
  std::vector<std::int64_t> of_unit_;   ///< [unit]
  std::int64_t count_ = 0;
};

}  // namespace coordreq
