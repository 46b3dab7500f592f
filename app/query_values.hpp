#pragma once

#include <cstdint>
#include <vector>

#include "numeric/rational.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Values of the inputs of a joint action of a class: row-major over its inputs, the last fastest.
[[nodiscard]] std::vector<Rational> values_of(const ProblemSpec& spec,
                                              const std::vector<std::int32_t>& inputs, std::size_t action);

}  // namespace coordreq
