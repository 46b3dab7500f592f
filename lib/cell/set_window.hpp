#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "answers/one_cell/cell_members.hpp"
#include "model/cell_block.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// The subset of a set of cells that a question needs, read when it is needed; answers whether boxes lie in
/// it, each in a time that does not depend on its size, from prefix sums.
class SetWindow : public CellMembers {
 public:
  /// Membership of the cells of a block: 0 or 1.
  using Read = std::function<std::vector<std::uint8_t>(const CellBlock&)>;

  /// @pre unchecked: `grid` outlives this object.
  SetWindow(const UniformGrid& grid, Read read) : grid_(grid), read_(std::move(read)) {}

  /// Reads the box unless it is there already.
  void cover(std::span<const IndexRange> box) override;
  /// Reads all of it.
  void cover_all();
  [[nodiscard]] bool contains(std::span<const IndexRange> box) const override;

 private:
  void add_up();
  [[nodiscard]] std::int64_t members(std::span<const IndexRange> box, std::size_t i,
                                     std::int64_t corner) const;

  const UniformGrid& grid_;
  Read read_;
  CellBlock block_;
  std::vector<std::int64_t> stride_;  ///< of `sums_`
  /// Members among the cells of the block before an index in every dimension; one entry more a
  /// dimension.
  std::vector<std::int32_t> sums_;
};

}  // namespace coordreq
