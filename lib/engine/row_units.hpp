#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/row_engine.hpp"
#include "engine/row_hull.hpp"

namespace coordreq {

/// The units of a wave: what it looks at, or passes over, as a whole. Those of the engine where it shares
/// minima within them, else single rows.
///
/// Immutable once built, so safe to share between threads.
class RowUnits {
 public:
  /// @pre unchecked: `engine` outlives this object.
  explicit RowUnits(const RowEngine& engine)
      : grid_(engine.grid()),
        dimensions_(engine.outer() == 0 ? engine.across() : engine.outer()),
        rows_(dimensions_ == 0 ? 1 : engine.grid().row_stride(dimensions_ - 1)) {
    for (std::size_t i = 0; i < dimensions_; ++i) strides_.push_back(grid_.row_stride(i) / rows_);
  }

  /// Number of leading dimensions that tell units apart.
  [[nodiscard]] std::size_t dimensions() const { return dimensions_; }
  /// Rows of a unit, which have neighbouring numbers.
  [[nodiscard]] std::int64_t rows() const { return rows_; }
  [[nodiscard]] std::int64_t count() const { return grid_.rows() / rows_; }
  [[nodiscard]] std::int64_t of(std::int64_t row) const { return row / rows_; }

  [[nodiscard]] RowPosition first_position() const { return {grid_, 0}; }
  /// position = the first row of a unit.
  void go_to(std::int64_t unit, RowPosition& position) const {
    position.row = unit * rows_;
    for (std::size_t i = dimensions_; i < position.index.size(); ++i) position.index[i] = 0;
    for (std::size_t i = dimensions_; i-- > 0; unit /= grid_[i].count)
      position.index[i] = unit % grid_[i].count;
  }
  /// ranges = the rows that a unit can meet, in the leading dimensions: there the box is the same for all of
  /// its rows. In others the first row may have none, as it need not be held. @param position go_to()
  void enclose(const RowHull& hull, const RowPosition& position, std::vector<IndexRange>& ranges) const {
    ranges.clear();
    for (std::size_t i = 0; i < dimensions_; ++i) ranges.push_back(hull.range(position, i));
  }
  /// Whether `test(unit)` is true for some unit of a box; stops at the first. @param ranges enclose()
  template <class Test>
  bool any_in(std::span<const IndexRange> ranges, std::vector<std::int64_t>& counter,
              const Test& test) const {
    return any_in_box(
        ranges, [&](std::size_t i) { return std::int64_t{grid_[i].count}; },
        [&](std::size_t i) { return strides_[i]; }, counter, test);
  }

 private:
  const UniformGrid& grid_;
  std::size_t dimensions_;
  std::int64_t rows_;
  std::vector<std::int64_t> strides_;  ///< [leading dimension] in units
};

}  // namespace coordreq
