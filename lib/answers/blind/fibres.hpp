#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/row_box.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// The fibres of a class (contract, section 8): cells that agree in all states that it sees. They are
/// numbered row-major over these states, in the order of the spec.
///
/// Example: states x of 3 cells and y of 2. A class that sees x alone has 3 fibres of 2 cells, one that sees
/// both has 6 of one cell, one that sees nothing a single one of 6:
///
///     cell (x, y)   (0,0) (0,1) (1,0) (1,1) (2,0) (2,1)
///     sees x          0     0     1     1     2     2
///     sees y          0     1     0     1     0     1
///
/// A class cannot distinguish the cells of a fibre, so it needs one action for all of them that are left. If
/// C(0,0) leaves it {-1, 0} and C(0,1) leaves it {0, 1}, that is 0; if they leave it {-1} and {1} there is
/// none, and the cells that lack the most frequent action are not in B_1.
class Fibres {
 public:
  /// @param seen states, ascending
  Fibres(const UniformGrid& grid, const std::vector<std::size_t>& seen);

  [[nodiscard]] std::int64_t count() const { return count_; }
  /// A cell is in fibre base(its row) + of_lane(its lane). Lanes that are no cells have no meaning.
  [[nodiscard]] std::int64_t base(const RowPosition& position) const { return position.offset(across_); }
  [[nodiscard]] std::int64_t of_lane(std::int64_t lane) const {
    return along_[static_cast<std::size_t>(lane)];
  }

 private:
  std::int64_t count_ = 1;
  std::vector<std::int64_t> across_;  ///< [dimension across rows] from one index to the next
  std::vector<std::int64_t> along_;   ///< [lane]
};

}  // namespace coordreq
