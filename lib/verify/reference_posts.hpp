#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "answers/checking/post_table.hpp"
#include "base/thread_team.hpp"
#include "numeric/rational.hpp"
#include "spec/spec_types.hpp"
#include "verify/sampled_map.hpp"

namespace coordreq {

/// A table of the right size without its entries.
/// @param cells only entries of these, with all inputs; all if empty
[[nodiscard]] PostTable empty_table(const UniformGrid& grid, const InputSpace& inputs,
                                    const Influences& influences, const std::vector<std::int64_t>& cells);

/// Raw indices of the cells that meet [lower, upper] (contract, "Cells"); the upper end alone may be missing.
[[nodiscard]] IndexRange meeting_cells(const GridDimension& dimension, Cells cells, const Rational& lower,
                                       const Rational& upper, bool upper_attained);

/// A state that saturates is at its limit when it is measured, however far beyond it went, and its
/// measurement may be off into another cell than the boundary one: adds those cells.
[[nodiscard]] IndexRange with_measurements_at_limits(const GridDimension& dimension, Cells cells,
                                                     IndexRange range);

/// The table of a state by corner evaluation: the values of its sampled map at all corners of each cell.
/// @param cells only entries of these are made; all if empty
/// @returns nothing if the map is not affine for some inputs or parameters
/// @throws SpecError if a discrete state may leave its grid
[[nodiscard]] std::optional<PostTable> corner_posts(const SystemSpec& spec, const UniformGrid& grid,
                                                    const InputSpace& inputs, std::size_t state,
                                                    const std::vector<std::int64_t>& cells, ThreadTeam& team);

/// An entry of tubes_between_ends() that the ends do not determine.
constexpr IndexRange kUnknownTube{INT32_MAX, INT32_MIN};

/// The tubes that the ends of the motion determine: of a state that is stopped itself, or moves in one
/// direction while limits stop others. Each entry as of cells_needed(), or kUnknownTube.
/// @returns nothing if no entry is known
[[nodiscard]] std::optional<PostTable> tubes_between_ends(const SystemSpec& spec, const UniformGrid& grid,
                                                          const InputSpace& inputs, std::size_t state,
                                                          const std::vector<std::int64_t>& cells,
                                                          ThreadTeam& team);

/// The table of a state that has an update, from its definition: every branch that a cell does not exclude.
/// @throws SpecError if it may leave its grid
[[nodiscard]] PostTable update_posts(const SystemSpec& spec, const UniformGrid& grid,
                                     const InputSpace& inputs, std::size_t state,
                                     const std::vector<std::int64_t>& cells, ThreadTeam& team);

}  // namespace coordreq
