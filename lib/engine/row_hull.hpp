#pragma once

#include <vector>

#include "engine/row_box.hpp"
#include "engine/row_engine.hpp"

namespace coordreq {

/// For each row the smallest box that holds the posts of its cells under all inputs: the rows that can matter
/// to it, and a bound for its levels that costs one look instead of one a joint action.
///
/// Blocked posts, and dimensions in which all has left for good, add nothing to the box.
class RowHull {
 public:
  /// @pre unchecked: `engine` outlives this object.
  explicit RowHull(const RowEngine& engine);

  /// What the posts of one row have in common.
  void box(const RowPlace& place, RowBox& box) const;
  /// Its range or window in dimension i.
  [[nodiscard]] IndexRange range(const RowPlace& place, std::size_t i) const { return hull(place, i).range; }
  /// The same for one choice of the states that its table uses.
  [[nodiscard]] IndexRange range_of(std::size_t choice, std::size_t i) const {
    return hulls_[i][choice].range;
  }

  /// [row] not 0 for the rows that posts and tubes of cells in some rows can meet. @param set of these; null:
  /// all
  [[nodiscard]] std::vector<std::uint8_t> rows_met(const CellSet* set, RowShare::Range rows) const;

  [[nodiscard]] std::uint64_t bytes() const;

 private:
  [[nodiscard]] const SliceHull& hull(const RowPlace& place, std::size_t i) const;

  const RowEngine* engine_;
  bool is_bound_ = true;                       ///< no tube can block a post, whatever its box is inside of
  std::vector<std::vector<SliceHull>> hulls_;  ///< [dimension][choice of the states that its table uses]
};

}  // namespace coordreq
