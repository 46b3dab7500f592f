#pragma once

#include <cstdint>

#include "spec/spec_types.hpp"

namespace coordreq {

/// The bits of the greatest float32 that a requirement `max_risk` lets a risk have: with what its steps add
/// at the rate it is at most what is asked for, exactly. Below 0: there is none.
[[nodiscard]] std::int32_t greatest_risk_bits(const RequirementSpec& requirement, double rate);

/// What is compared for a risk of these bits: that and what the steps add at the rate, rounded up; at most 1.
[[nodiscard]] double compared_risk(const RequirementSpec& requirement, std::int32_t bits, double rate);

}  // namespace coordreq
