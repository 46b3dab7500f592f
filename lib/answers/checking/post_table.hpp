#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/requires.hpp"
#include "model/input_space.hpp"
#include "model/outside.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// Where one state can be a period later: raw ranges of grid indices, before `outside` is applied, for each
/// choice of the states and inputs that they depend on, or for the choices of some cells alone.
struct PostTable {
  std::vector<std::size_t> states;  ///< ascending
  std::vector<std::size_t> inputs;  ///< ascending
  std::vector<IndexRange> entries;  ///< row-major over `states`, then `inputs`
  std::vector<std::int64_t>
      positions;  ///< [entry] its position in the whole table, ascending; empty if no entry is left out
  std::vector<std::int64_t> state_stride;  ///< one for each state of the spec; 0 if it has no influence
  std::vector<std::int64_t> input_stride;
  bool exact = true;  ///< the ranges are those of the contract, not only enclosures of them

  /// Place of an entry in a table that leaves none out.
  [[nodiscard]] std::int64_t position_of(std::size_t entry) const {
    return positions.empty() ? static_cast<std::int64_t>(entry) : positions[entry];
  }
  /// The entry with a place; nothing if it is left out.
  [[nodiscard]] std::optional<std::size_t> find(std::int64_t position) const;
  /// The entry at a place. @pre the entry is not left out
  [[nodiscard]] const IndexRange& at(std::int64_t position) const {
    const std::optional<std::size_t> found = find(position);
    REQUIRES(found.has_value());
    return entries[*found];
  }
  /// The first entry of a cell; its entries for other inputs follow. @pre they are not left out
  [[nodiscard]] std::size_t entry_of(const UniformGrid& grid, std::int64_t cell) const;
};

/// The places of the entries of some cells, with all inputs, ascending.
[[nodiscard]] std::vector<std::int64_t> entry_positions(const PostTable& table, const UniformGrid& grid,
                                                        const InputSpace& inputs,
                                                        const std::vector<std::int64_t>& cells);

/// The part of a whole table for some cells; all of it if `cells` is empty.
[[nodiscard]] PostTable subset_of(const PostTable& whole, const UniformGrid& grid, const InputSpace& inputs,
                                  const std::vector<std::int64_t>& cells);

}  // namespace coordreq
