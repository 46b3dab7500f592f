#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/row_box.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// The fibres of a class (contract, section 8): cells that agree in all states that it sees. They are
/// numbered row-major over these states, in the order of the spec.
class Fibres {
 public:
  /// @param seen states, ascending
  Fibres(const UniformGrid& grid, const std::vector<std::size_t>& seen);

  [[nodiscard]] std::int64_t count() const { return count_; }
  /// A cell is in fibre base(its row) + of_lane(its lane). Lanes that are no cells have no meaning.
  [[nodiscard]] std::int64_t base(const RowPlace& place) const { return place.offset(across_); }
  [[nodiscard]] std::int64_t of_lane(std::int64_t lane) const {
    return along_[static_cast<std::size_t>(lane)];
  }

 private:
  std::int64_t count_ = 1;
  std::vector<std::int64_t> across_;  ///< [dimension across rows] from one index to the next
  std::vector<std::int64_t> along_;   ///< [lane]
};

}  // namespace coordreq
