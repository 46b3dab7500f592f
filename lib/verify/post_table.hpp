#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/thread_team.hpp"
#include "model/input_space.hpp"
#include "model/outside.hpp"
#include "model/uniform_grid.hpp"
#include "numeric/rational.hpp"
#include "spec/problem_spec.hpp"
#include "verify/sampled_map.hpp"

namespace coordreq {

/// Where one state can be a period later: raw ranges of grid indices, before `outside` is applied, remembered
/// for each choice of what they depend on, or for those choices alone that some cells make.
struct PostTable {
  std::vector<std::size_t> states;         ///< ascending
  std::vector<std::size_t> inputs;         ///< ascending
  std::vector<IndexRange> entries;         ///< row-major over `states`, then `inputs`
  std::vector<std::int64_t> places;        ///< of the entries if some are left out, ascending; else empty
  std::vector<std::int64_t> state_stride;  ///< one for each state of the spec; 0 if it has no influence
  std::vector<std::int64_t> input_stride;
  bool exact = true;  ///< the ranges are those of the contract, not only enclosures of them

  /// Place of an entry among those of a table that leaves none out.
  [[nodiscard]] std::int64_t place_of(std::size_t entry) const {
    return places.empty() ? static_cast<std::int64_t>(entry) : places[entry];
  }
  /// The entry with a place; nothing if it is left out.
  [[nodiscard]] std::optional<std::size_t> find(std::int64_t place) const;
  /// REQUIRES: it is not left out.
  [[nodiscard]] const IndexRange& at(std::int64_t place) const { return entries[*find(place)]; }
  /// The first entry of a cell; those of its other inputs follow. REQUIRES: they are not left out.
  [[nodiscard]] std::size_t entry_of(const UniformGrid& grid, std::int64_t cell) const;
};

/// A table of the right size without its entries.
/// @param cells only entries of these, with all inputs; all if empty
[[nodiscard]] PostTable empty_table(const UniformGrid& grid, const InputSpace& inputs,
                                    const Influences& influences, const std::vector<std::int64_t>& cells);

/// What a whole table says of some cells; all of it if `cells` is empty.
[[nodiscard]] PostTable part_of(const PostTable& whole, const UniformGrid& grid, const InputSpace& inputs,
                                const std::vector<std::int64_t>& cells);

/// Raw indices of the cells that meet [lower, upper] (contract, "Cells"); the upper end alone may be missing.
[[nodiscard]] IndexRange cells_met(const GridDimension& dimension, Cells cells, const Rational& lower,
                                   const Rational& upper, bool upper_attained);

/// A state that saturates is at its limit when it is measured, however far beyond it went, and its
/// measurement may be off into another cell than the boundary one: adds those cells.
[[nodiscard]] IndexRange with_measurements_at_limits(const GridDimension& dimension, Cells cells,
                                                     IndexRange range);

/// The table of a state by corner evaluation: the values of its sampled map at all corners of each cell.
/// @param cells only entries of these are made; all if empty
/// @returns nothing if the map is not affine for some inputs or parameters
/// @throws SpecError if a discrete state may leave its grid
[[nodiscard]] std::optional<PostTable> corner_posts(const ProblemSpec& spec, const UniformGrid& grid,
                                                    const InputSpace& inputs, std::size_t state,
                                                    const std::vector<std::int64_t>& cells, ThreadTeam& team);

}  // namespace coordreq
