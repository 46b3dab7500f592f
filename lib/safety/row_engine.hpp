#pragma once

#include <cstdint>
#include <vector>

#include "abstraction/abstraction.hpp"
#include "bitset/level_rows.hpp"
#include "safety/condition_table.hpp"
#include "safety/row_place.hpp"
#include "safety/row_slices.hpp"

namespace coordreq {

/// The abstraction laid out for whole rows of cells, and how work on it is cut up.
///
/// The post of a row is the minimum over a box of rows (other dimensions) of levels, and over a window along
/// the row (last dimension). Where the first `outer()` dimensions move by themselves, whatever the others do,
/// the minimum over them is the same for all rows that share these indices: a *unit*. PostReader takes it
/// once. Immutable once built, so safe to share between threads.
class RowEngine {
 public:
  /// REQUIRES: `abstraction` and `allow` (may be null: everything is allowed) outlive this object.
  RowEngine(const Abstraction& abstraction, const ConditionTable* allow);

  [[nodiscard]] const Abstraction& abstraction() const { return *abstraction_; }
  [[nodiscard]] const UniformGrid& grid() const { return abstraction_->grid; }
  /// One table of slices a state. In the last one offsets are at most a row long, either way.
  [[nodiscard]] const std::vector<RowSlices>& slices() const { return slices_; }
  [[nodiscard]] const ConditionTable* allow() const { return allow_; }
  [[nodiscard]] std::int64_t rows() const { return grid().rows(); }
  [[nodiscard]] std::int64_t row_length() const { return grid().row_length(); }
  [[nodiscard]] std::size_t row_words() const {
    return static_cast<std::size_t>((row_length() + CellSet::kWordBits - 1) / CellSet::kWordBits);
  }
  /// Number of tables of slices: one a state.
  [[nodiscard]] std::size_t tables() const { return slices_.size(); }
  /// Rows from one index of a dimension (not the last) to the next.
  [[nodiscard]] std::int64_t row_stride(std::size_t dimension) const { return row_stride_[dimension]; }

  /// Number of leading dimensions whose minimum is shared by the rows of a unit; may be 0.
  [[nodiscard]] std::size_t outer() const { return outer_; }
  /// Rows of a unit, which have neighbouring numbers. All rows if outer() is 0.
  [[nodiscard]] std::int64_t unit_rows() const { return unit_rows_; }

  /// Levels of all rows, 0, with the margins that posts ask for.
  template <class Level>
  [[nodiscard]] LevelRows<Level> make_levels() const {
    return {rows(), row_length(), margins_, ends()};
  }
  [[nodiscard]] RowEnds ends() const {
    const GridDimension& last = grid().dimensions().back();
    return {last.below, last.above};
  }
  [[nodiscard]] const RowMargins& margins() const { return margins_; }

 private:
  void fit_offsets();
  void choose_outer();
  [[nodiscard]] bool is_closed(std::size_t outer) const;

  const Abstraction* abstraction_;
  const ConditionTable* allow_;
  std::vector<RowSlices> slices_;
  std::vector<std::int64_t> row_stride_;
  RowMargins margins_;
  std::size_t outer_ = 0;
  std::int64_t unit_rows_ = 1;
};

}  // namespace coordreq
