#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "bitset/level_kernels.hpp"
#include "bitset/row_operations.hpp"

namespace coordreq {

/// How many cells of the lattice beyond each end of a row can be asked for.
struct RowMargins {
  std::int64_t before = 0;
  std::int64_t after = 0;
};

/// One level a cell, in rows along the last dimension, each continued beyond its ends by what a post meets
/// there.
///
/// A level says how long a cell stays in a decreasing sequence of sets: 0 outside the first of them, i if it
/// is in the first i, and `kTop` if it is never lost (as far as is known). Min and max over levels are AND
/// and OR over all sets of the sequence at once.
///
/// 8 bits are enough for most problems; Level is the narrowest of 8, 16, 32 bits that all finite levels fit
/// into.
template <class Level>
class LevelRows {
 public:
  static constexpr Level kTop = std::numeric_limits<Level>::max();

  LevelRows() = default;
  LevelRows(std::int64_t rows, std::int64_t row_length, RowMargins margins, RowEnds ends)
      : rows_(rows), length_(row_length), margins_(margins), ends_(ends) {
    constexpr std::int64_t kAlign = 16 / static_cast<std::int64_t>(sizeof(Level));
    stride_ = (margins.before + row_length + margins.after + kAlign - 1) / kAlign * kAlign;
    levels_.resize(static_cast<std::size_t>(rows * stride_) + kLevelBlock / sizeof(Level), 0);
  }

  [[nodiscard]] std::int64_t rows() const { return rows_; }
  [[nodiscard]] std::int64_t row_length() const { return length_; }
  [[nodiscard]] const RowMargins& margins() const { return margins_; }
  [[nodiscard]] const RowEnds& ends() const { return ends_; }
  /// Levels from one row to the next.
  [[nodiscard]] std::int64_t stride() const { return stride_; }
  [[nodiscard]] std::size_t bytes() const { return levels_.size() * sizeof(Level); }

  /// First cell of a row; margins().before levels stand before it, margins().after after its last.
  [[nodiscard]] Level* row(std::int64_t r) { return levels_.data() + r * stride_ + margins_.before; }
  [[nodiscard]] const Level* row(std::int64_t r) const {
    return levels_.data() + r * stride_ + margins_.before;
  }

  /// Brings the margins of a row up to date with its cells.
  void close(std::int64_t r) { close_row(row(r)); }
  /// The same for a row of this layout that stands elsewhere.
  void close_row(Level* cells) const {
    if (ends_.below == Outside::periodic) {
      for (std::int64_t k = 1; k <= margins_.before; ++k) {
        cells[-k] = cells[(length_ - k % length_) % length_];
      }
      for (std::int64_t k = 0; k < margins_.after; ++k) cells[length_ + k] = cells[k % length_];
      return;
    }
    std::fill_n(cells - margins_.before, margins_.before, beyond(ends_.below, cells[0]));
    std::fill_n(cells + length_, margins_.after, beyond(ends_.above, cells[length_ - 1]));
  }

 private:
  [[nodiscard]] static Level beyond(Outside rule, Level boundary) {
    if (rule == Outside::unsafe) return 0;
    return rule == Outside::safe ? kTop : boundary;
  }

  std::int64_t rows_ = 0;
  std::int64_t length_ = 0;
  RowMargins margins_;
  RowEnds ends_;
  std::int64_t stride_ = 0;
  std::vector<Level> levels_;
};

}  // namespace coordreq
