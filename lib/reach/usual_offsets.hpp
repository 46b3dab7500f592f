#pragma once

#include <vector>

#include "model/outside.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// For each state about how far its next index is from the present one, at the most either way: its equation
/// over the whole domain, for one period. Proves nothing; for estimates.
[[nodiscard]] std::vector<IndexRange> usual_offsets(const SystemSpec& spec);

}  // namespace coordreq
