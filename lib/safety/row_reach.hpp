#pragma once

#include <cstdint>
#include <vector>

#include "safety/row_engine.hpp"

namespace coordreq {

/// Which rows the posts of a row can meet under any input: a box of rows, by dimension. Over-approximates.
class RowReach {
 public:
  explicit RowReach(const RowEngine& engine);

  /// True if a row with `changed` != 0 lies in the box of `row`.
  /// @param changed_before prefix sums: [r] = number of changed rows below r, rows() + 1 entries
  [[nodiscard]] bool meets(std::int64_t row, const std::vector<std::int64_t>& changed_before) const;

 private:
  [[nodiscard]] bool meets_from(std::size_t dimension, std::int64_t row, std::int64_t first_row,
                                const std::vector<std::int64_t>& changed_before) const;

  const RowEngine* engine_;
  std::vector<std::vector<IndexRange>>
      ranges_;  ///< [dimension][row choice of its table], as in ResolvedRange; first > last: meets none
};

}  // namespace coordreq
