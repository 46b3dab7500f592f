#pragma once

#include <cstdint>
#include <vector>

#include "model/input_space.hpp"
#include "model/outside.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// Where one state can be a period later: raw ranges of grid indices, before `outside` is applied, remembered
/// for each choice of what they depend on.
struct PostTable {
  std::vector<std::size_t> states;         ///< ascending
  std::vector<std::size_t> inputs;         ///< ascending
  std::vector<IndexRange> entries;         ///< row-major over `states`, then `inputs`
  std::vector<std::int64_t> state_stride;  ///< one for each state of the spec; 0 if it has no influence
  std::vector<std::int64_t> input_stride;
  bool exact = true;  ///< the ranges are those of the contract, not only enclosures of them

  /// The entries of a cell begin here.
  [[nodiscard]] std::int64_t first_entry(const UniformGrid& grid, std::int64_t cell) const {
    std::int64_t entry = 0;
    for (const std::size_t j : states) entry += grid.index(cell, j) * state_stride[j];
    return entry;
  }
};

/// Which entries some cells have, with all inputs; empty if `cells` is: all of them.
[[nodiscard]] std::vector<bool> entries_of(const UniformGrid& grid, const InputSpace& inputs,
                                           const PostTable& table, const std::vector<std::int64_t>& cells);

}  // namespace coordreq
