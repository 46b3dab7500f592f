#pragma once

#include "base/archive.hpp"
#include "engine/cell_set.hpp"
#include "engine/level_rows.hpp"

// Views of levels and sets for an archive.
namespace coordreq {

/// The cells of levels, without their margins.
template <class Level>
[[nodiscard]] NumberRows rows_of(const LevelRows<Level>& levels) {
  if (levels.rows() == 0) return {};
  NumberRows rows = number_rows(levels.first_slot(), levels.stride(), levels.rows(), levels.row_length());
  if (levels.is_interned()) rows.places = levels.slots().data();
  return rows;
}

[[nodiscard]] inline NumberRows rows_of(const CellSet& set) {
  return number_rows(set.words().data(), set.words_per_row(), set.rows(), set.words_per_row());
}

}  // namespace coordreq
