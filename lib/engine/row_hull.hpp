#pragma once

#include <vector>

#include "engine/row_box.hpp"
#include "engine/row_engine.hpp"

namespace coordreq {

/// For each row the smallest box that holds the posts of its cells under all inputs: it names the rows that
/// posts can meet.
///
/// Segments that are blocked, or gone, add nothing to the box.
/// Immutable once built, so safe to share between threads.
class RowHull {
 public:
  /// @pre unchecked: `engine` outlives this object.
  /// @param team for large tables; null: this thread alone
  explicit RowHull(const RowEngine& engine, ThreadTeam* team = nullptr);

  /// box = the box of the posts of a row.
  void box(const RowPosition& position, RowBox& box) const;
  /// The range or window of that box in dimension i.
  [[nodiscard]] IndexRange range(const RowPosition& position, std::size_t i) const;
  /// range() for a choice of the states that the table of dimension i uses.
  [[nodiscard]] IndexRange range_of(std::size_t choice, std::size_t i) const { return hulls_[i][choice]; }

  /// [row] not 0 for the rows that posts and tubes of cells in some rows can meet.
  /// @param set of the cells; null: all cells of the rows
  [[nodiscard]] std::vector<std::uint8_t> rows_reached(const CellSet* set, RowShare::Range rows) const;

  [[nodiscard]] std::uint64_t bytes() const;

 private:
  const RowEngine* engine_;
  std::vector<std::vector<IndexRange>> hulls_;  ///< [dimension][choice of the states that its table uses]
};

}  // namespace coordreq
