#pragma once

#include <cstdint>
#include <vector>

#include "bitset/cell_set.hpp"
#include "coordination/delay_layers.hpp"
#include "results/result_content.hpp"

// Turns what the analysis holds into the arrays of the results file. The functions returned refer to their
// arguments, which must outlive the writing.
namespace coordreq {

/// uint8 [cells], 1 for members.
[[nodiscard]] ResultArray membership_array(const CellSet& set);

/// The narrowest of int16 and int32 that holds all finite values below its maximum (contract, section 4).
/// @param infinite the value that stands for "no end" in `values`
[[nodiscard]] ElementType level_type(const std::vector<std::int32_t>& values, std::int32_t infinite);

/// The values in `type`; `infinite` becomes the type's maximum.
[[nodiscard]] ResultArray level_array(const std::vector<std::int32_t>& values, std::int32_t infinite,
                                      ElementType type);

/// The trigger table of the delays, in `type`.
[[nodiscard]] ResultArray trigger_array(const std::vector<std::int32_t>& delays,
                                        std::int64_t connection_delay, ElementType type);

/// T(0), ..., T(F) as ascending lists of linear indices. The lists belong to the result.
[[nodiscard]] ResultLayers layer_lists(const DelayLayers& layers);

}  // namespace coordreq
