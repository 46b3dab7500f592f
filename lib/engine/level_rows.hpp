#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "engine/level_kernels.hpp"
#include "engine/row_operations.hpp"
#include "model/outside.hpp"

namespace coordreq {

/// How many cells of the lattice beyond each end of a row can be asked for.
struct RowMargins {
  std::int64_t before = 0;
  std::int64_t after = 0;
};

/// One of the dimensions that rows run along.
struct RowDimension {
  std::int64_t count = 0;   ///< indices
  std::int64_t stride = 1;  ///< lanes from one index to the next
  RowMargins margins;       ///< in indices; together at most the gap that the dimension has in the rows
  RowEnds ends;
};

/// How a row is laid out: cells and gaps in *lanes*, from the slowest dimension to the fastest, whose stride
/// is 1.
struct RowShape {
  std::vector<RowDimension> dimensions;

  /// Lanes of a row, those of the gaps included.
  [[nodiscard]] std::int64_t length() const { return dimensions.front().count * dimensions.front().stride; }
  /// Lanes before and after a row that posts of its cells can meet.
  [[nodiscard]] RowMargins margins() const {
    RowMargins lanes;
    for (const RowDimension& dimension : dimensions) {
      lanes.before += dimension.margins.before * dimension.stride;
      lanes.after += dimension.margins.after * dimension.stride;
    }
    return lanes;
  }
  /// Calls `visit(lane, count)` for every run of cells along the fastest dimension.
  template <class Visit>
  void for_each_run(const Visit& visit, std::size_t k = 0, std::int64_t lane = 0) const {
    const RowDimension& dimension = dimensions[k];
    if (k + 1 == dimensions.size()) return visit(lane, dimension.count);
    for (std::int64_t i = 0; i < dimension.count; ++i)
      for_each_run(visit, k + 1, lane + i * dimension.stride);
  }
};

/// Sets the bits of the cells of a row from which `window`, offsets in dimension k of the row, reaches beyond
/// an unsafe end. Bits of gaps may be set too.
inline void mark_leaving(const RowShape& shape, std::size_t k, IndexRange window, MutableRow bits) {
  const RowDimension& dimension = shape.dimensions[k];
  const std::int64_t n = dimension.count;
  const auto mark = [&](std::int64_t first, std::int64_t last) {
    if (first >= last) return;
    // Blocks of n indices follow one another at the distance that the next slower dimension has.
    const std::int64_t block = k == 0 ? shape.length() : shape.dimensions[k - 1].stride;
    for (std::int64_t lane = 0; lane < shape.length(); lane += block)
      set_bits(bits, lane + first * dimension.stride, lane + last * dimension.stride);
  };
  if (traits(dimension.ends.below).blocks)
    mark(0, std::clamp<std::int64_t>(-std::int64_t{window.first}, 0, n));
  if (traits(dimension.ends.above).blocks) mark(n - std::clamp<std::int64_t>(window.last, 0, n), n);
}

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
