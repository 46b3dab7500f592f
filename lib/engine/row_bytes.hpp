#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/cell_set.hpp"
#include "engine/level_rows.hpp"

namespace coordreq {

/// Rows of numbers where they stand in memory, without what lies between them.
struct RowBytes {
  const std::byte* first = nullptr;  ///< of the first row
  std::ptrdiff_t stride = 0;         ///< from one row to the next
  std::int64_t rows = 0;
  std::int64_t row_bytes = 0;      ///< of the numbers of a row
  std::int64_t element_bytes = 1;  ///< of a number

  [[nodiscard]] const std::byte* row(std::int64_t r) const { return first + r * stride; }
};

/// The cells of levels, without their margins.
template <class Level>
[[nodiscard]] RowBytes bytes_of(const LevelRows<Level>& levels) {
  constexpr std::int64_t kSize = sizeof(Level);
  const void* first = levels.rows() == 0 ? nullptr : levels.row(0);
  return {static_cast<const std::byte*>(first), levels.stride() * kSize, levels.rows(),
          levels.row_length() * kSize, kSize};
}

[[nodiscard]] inline RowBytes bytes_of(const CellSet& set) {
  constexpr std::int64_t kSize = sizeof(CellSet::Word);
  const void* first = set.words().data();
  return {static_cast<const std::byte*>(first), set.words_per_row() * kSize, set.rows(),
          set.words_per_row() * kSize, kSize};
}

}  // namespace coordreq
