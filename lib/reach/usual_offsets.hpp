#pragma once

#include <cstdint>
#include <vector>

#include "model/outside.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// For each state about how far its next index is from the present one, at the most either way: its equation
/// over the whole domain, for one period. Proves nothing; for estimates.
[[nodiscard]] std::vector<IndexRange> usual_offsets(const SystemSpec& spec);

/// For each state by about how many indices the two ends of a post are apart, at the most: its equation over
/// the cell in the middle of the domain, under the middle inputs. Proves nothing either.
[[nodiscard]] std::vector<std::int32_t> usual_widths(const SystemSpec& spec);

}  // namespace coordreq
