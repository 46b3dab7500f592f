#pragma once

#include <cstdint>

#include "spec/spec_types.hpp"

namespace coordreq {

/// The bits of the greatest float32 that fulfils a requirement `max_risk`: with the part of the rate for its
/// steps it is at most the limit, exactly. Below 0: there is none.
[[nodiscard]] std::int32_t greatest_risk_bits(const RequirementSpec& requirement, double rate);

/// The risk of these bits with the part of the rate for the steps, rounded up, at most 1: this is compared
/// with the limit.
[[nodiscard]] double compared_risk(const RequirementSpec& requirement, std::int32_t bits, double rate);

}  // namespace coordreq
