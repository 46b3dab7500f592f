#pragma once

#include <cstdint>
#include <vector>

#include "numeric/rational.hpp"
#include "results/results_reader.hpp"

namespace coordreq {

/// Whether a delay is a lower bound only: the largest one of a partition that max_delay cut off.
[[nodiscard]] bool is_lower_bound(std::int32_t delay, const StoredPartition& partition);

/// Values of the inputs of a joint action of a class: row-major over its inputs, the last fastest.
[[nodiscard]] std::vector<Rational> values_of(const ProblemSpec& spec,
                                              const std::vector<std::int32_t>& inputs, std::size_t action);

}  // namespace coordreq
