#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>

#include "model/outside.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// Calls `visit(cell)` for the cells of a box of ranges, which may wrap in periodic dimensions, until it
/// returns false.
/// @returns false if it was stopped
template <class Visit>
bool for_each_cell(const UniformGrid& grid, std::span<const IndexRange> box, const Visit& visit,
                   std::size_t i = 0, std::int64_t cell = 0) {
  if (i == box.size()) return visit(cell);
  for (std::int64_t k = box[i].first; k <= box[i].last; ++k) {
    if (!for_each_cell(grid, box, visit, i + 1, cell + k % grid[i].count * grid.stride(i))) return false;
  }
  return true;
}

/// A set of cells that says whether boxes lie in it. Ranges as ResolvedRange::inside has them: an index
/// beyond the last one of a periodic dimension wraps.
class CellMembers {
 public:
  CellMembers() = default;
  CellMembers(const CellMembers&) = delete;
  CellMembers& operator=(const CellMembers&) = delete;
  virtual ~CellMembers() = default;

  /// Prepares for boxes inside this box.
  virtual void cover(std::span<const IndexRange> box) = 0;
  /// Whether all cells of the box are in the set. @pre unchecked: cover() was called for the box, or for one
  /// around it.
  [[nodiscard]] virtual bool contains(std::span<const IndexRange> box) const = 0;
};

/// A set in memory. Cost of a box: its cells.
class MembersByCell : public CellMembers {
 public:
  using IsMember = std::function<bool(std::int64_t cell)>;
  /// @pre unchecked: `grid` outlives this object.
  MembersByCell(const UniformGrid& grid, IsMember is_member)
      : grid_(grid), is_member_(std::move(is_member)) {}

  void cover(std::span<const IndexRange> /*box*/) override {}
  [[nodiscard]] bool contains(std::span<const IndexRange> box) const override {
    return for_each_cell(grid_, box, is_member_);
  }

 private:
  const UniformGrid& grid_;
  IsMember is_member_;
};

}  // namespace coordreq
