#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>

#include "model/outside.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// A set of cells, of which it is asked whether boxes lie in it. Ranges as ResolvedRange::inside has them: an
/// index beyond the last one of a periodic dimension wraps.
class CellMembers {
 public:
  CellMembers() = default;
  CellMembers(const CellMembers&) = delete;
  CellMembers& operator=(const CellMembers&) = delete;
  virtual ~CellMembers() = default;

  /// Makes ready for boxes within this one.
  virtual void cover(std::span<const IndexRange> box) = 0;
  /// Whether all cells of the box are in the set. REQUIRES: a box that cover() was called for, or part of
  /// one.
  [[nodiscard]] virtual bool contains(std::span<const IndexRange> box) const = 0;
};

/// A set in memory. Cost of a box: its cells.
class MembersByCell : public CellMembers {
 public:
  using IsMember = std::function<bool(std::int64_t cell)>;
  /// REQUIRES: `grid` outlives this object.
  MembersByCell(const UniformGrid& grid, IsMember is_member)
      : grid_(grid), is_member_(std::move(is_member)) {}

  void cover(std::span<const IndexRange> /*box*/) override {}
  [[nodiscard]] bool contains(std::span<const IndexRange> box) const override {
    return contains_from(box, 0, 0);
  }

 private:
  [[nodiscard]] bool contains_from(std::span<const IndexRange> box, std::size_t i, std::int64_t cell) const {
    if (i == box.size()) return is_member_(cell);
    for (std::int64_t k = box[i].first; k <= box[i].last; ++k) {
      if (!contains_from(box, i + 1, cell + k % grid_[i].count * grid_.stride(i))) return false;
    }
    return true;
  }

  const UniformGrid& grid_;
  IsMember is_member_;
};

}  // namespace coordreq
