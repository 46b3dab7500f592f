#pragma once

#include <cstdint>
#include <vector>

#include "model/dependencies.hpp"

namespace coordreq {

/// The variables that the next value of one state depends on, and the form and size of its table; known
/// without the entries. Indices are those of the spec's lists, ascending.
struct TableShape : Dependencies {
  std::vector<std::int32_t> states;  ///< moving and parameters, the own one included, if it depends on it
  std::vector<std::int32_t> terms;   ///< states in which it is affine, with a term each; of a sum only
  bool shift = false;  ///< only as an offset to the present value, kept once for all present ones
  bool sum = false;    ///< there are terms; if that fails it is in full after all
  double entries = 1;  ///< that are stored; may be beyond what an integer holds
  double bytes = 0;

  /// Entries are for every cell, if it is in full. @param all states there are
  [[nodiscard]] bool is_by_cells(std::size_t all) const { return !shift && !sum && states.size() == all; }
};

}  // namespace coordreq
