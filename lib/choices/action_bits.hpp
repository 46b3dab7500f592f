#pragma once

#include <cstdint>
#include <vector>

#include "choices/controller.hpp"
#include "engine/action_groups.hpp"

namespace coordreq {

/// Writes sets of actions as packed bits, one set a cell: bit a % 8 of byte a / 8 is action a.
///
/// For every cell of the rows [first_row, last_row): the projection of C(x) onto class c of the grouping
/// (contract, `/actions`). With one class of all inputs this is C(x) itself (`/controller`). Computed when
/// called, since C is never stored.
/// @returns bytes [rows, row_length, ceil(actions / 8)]
[[nodiscard]] std::vector<std::uint8_t> action_bits(const Controller& controller,
                                                    const ActionGrouping& grouping, std::size_t c,
                                                    std::int64_t first_row, std::int64_t last_row);

/// Adds an action to the sets of some cells of a row. @param cells [row_length, bytes]
void add_action(ConstRow row, std::size_t action, std::int64_t bytes, std::uint8_t* cells);

/// Fills the segment [begin, begin + count) of these bytes over the whole grid, row-major.
void fill_action_bits(const Controller& controller, const ActionGrouping& grouping, std::size_t c,
                      std::uint64_t begin, std::uint64_t count, void* out);

}  // namespace coordreq
