#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "engine/cell_set.hpp"
#include "engine/level_kernels.hpp"
#include "engine/row_shape.hpp"

namespace coordreq {

/// One level a cell, in rows, each continued beyond its ends, and those of the runs in it, by what a post
/// meets there.
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
      : LevelRows(rows, {{{row_length, 1, margins, ends}}}) {}
  LevelRows(std::int64_t rows, RowShape shape)
      : rows_(rows), shape_(std::move(shape)), length_(shape_.length()), margins_(shape_.margins()) {
    constexpr std::int64_t kAlign = 16 / static_cast<std::int64_t>(sizeof(Level));
    stride_ = (margins_.before + length_ + margins_.after + kAlign - 1) / kAlign * kAlign;
    levels_.resize(static_cast<std::size_t>(rows * stride_) + kLevelBlock / sizeof(Level), 0);
  }

  [[nodiscard]] std::int64_t rows() const { return rows_; }
  /// Lanes of a row, gaps included.
  [[nodiscard]] std::int64_t row_length() const { return length_; }
  /// In lanes.
  [[nodiscard]] const RowMargins& margins() const { return margins_; }
  [[nodiscard]] const RowShape& shape() const { return shape_; }
  /// Levels from one row to the next.
  [[nodiscard]] std::int64_t stride() const { return stride_; }
  [[nodiscard]] std::size_t bytes() const { return levels_.size() * sizeof(Level); }

  /// First cell of a row; margins().before levels stand before it, margins().after after its last.
  [[nodiscard]] Level* row(std::int64_t r) { return levels_.data() + r * stride_ + margins_.before; }
  [[nodiscard]] const Level* row(std::int64_t r) const {
    return levels_.data() + r * stride_ + margins_.before;
  }

  /// Makes the cells of a set in the rows [begin, end) the greatest level, others 0, margins included.
  void assign(const CellSet& set, std::int64_t begin, std::int64_t end) {
    const LevelKernels<Level>& kernels = level_kernels<Level>(best_instruction_set());
    // By way of a buffer: the kernel writes whole blocks, beyond the row.
    std::vector<Level> lanes(static_cast<std::size_t>(length_) + kLevelBlock / sizeof(Level));
    for (std::int64_t r = begin; r < end; ++r) {
      kernels.spread(set.row(r).data(), lanes.data(), static_cast<std::size_t>(length_));
      std::copy_n(lanes.begin(), length_, row(r));
      close(r);
    }
  }

  /// Brings the margins and gaps of a row up to date with its cells.
  void close(std::int64_t r) { close_row(row(r)); }
  /// The same for a row of this layout that stands elsewhere.
  void close_row(Level* cells) const { close_part(cells, 0); }

  /// Sets the gaps of a row, or of a copy of it, to 0.
  void clear_gaps(Level* cells) const {
    if (shape_.dimensions.size() == 1) return;
    std::int64_t end = 0;
    shape_.for_each_run([&](std::int64_t lane, std::int64_t count) {
      std::fill(cells + end, cells + lane, Level{0});
      end = lane + count;
    });
    std::fill(cells + end, cells + length_, Level{0});
  }

 private:
  /// The part of a row along the dimensions from k on that begins at `cells`.
  void close_part(Level* cells, std::size_t k) const {
    const RowDimension& dimension = shape_.dimensions[k];
    if (k + 1 == shape_.dimensions.size()) return close_run(cells, dimension);
    for (std::int64_t i = 0; i < dimension.count; ++i) close_part(cells + i * dimension.stride, k + 1);
    for (std::int64_t i = -dimension.margins.before; i < 0; ++i) continue_part(cells, k, i);
    for (std::int64_t i = 0; i < dimension.margins.after; ++i) continue_part(cells, k, dimension.count + i);
  }

  /// Fills in what stands at an index beyond the ends, over all lanes of the dimensions after k.
  void continue_part(Level* cells, std::size_t k, std::int64_t index) const {
    const RowDimension& dimension = shape_.dimensions[k];
    std::int64_t before = 0;
    std::int64_t after = 1;
    for (std::size_t j = k + 1; j < shape_.dimensions.size(); ++j) {
      const RowDimension& other = shape_.dimensions[j];
      before += other.margins.before * other.stride;
      after += (other.count - 1 + other.margins.after) * other.stride;
    }
    Level* const part = cells + index * dimension.stride;
    const OutsideTraits& rule = traits(index < 0 ? dimension.ends.below : dimension.ends.above);
    if (rule.is_open()) {
      std::fill(part - before, part + after, rule.arrives ? kTop : Level{0});
      // What leaves safely here may leave through an unsafe side there.
      if (rule.arrives) close_part(part, k + 1);
      return;
    }
    const std::int64_t n = dimension.count;
    const std::int64_t source = rule.wraps ? (index % n + n) % n : (index < 0 ? 0 : n - 1);
    const Level* const other = cells + source * dimension.stride;
    std::copy(other - before, other + after, part - before);
  }

  static void close_run(Level* cells, const RowDimension& run) {
    const std::int64_t n = run.count;
    if (traits(run.ends.below).wraps) {
      for (std::int64_t k = 1; k <= run.margins.before; ++k) cells[-k] = cells[(n - k % n) % n];
      for (std::int64_t k = 0; k < run.margins.after; ++k) cells[n + k] = cells[k % n];
      return;
    }
    std::fill_n(cells - run.margins.before, run.margins.before, beyond(run.ends.below, cells[0]));
    std::fill_n(cells + n, run.margins.after, beyond(run.ends.above, cells[n - 1]));
  }

  [[nodiscard]] static Level beyond(Outside rule, Level boundary) {
    if (traits(rule).blocks) return 0;
    return traits(rule).arrives ? kTop : boundary;
  }

  std::int64_t rows_ = 0;
  RowShape shape_;
  std::int64_t length_ = 0;
  RowMargins margins_;
  std::int64_t stride_ = 0;
  std::vector<Level> levels_;
};

}  // namespace coordreq
