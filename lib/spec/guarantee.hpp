#pragma once

#include <string>

#include "spec/problem_spec.hpp"

namespace coordreq {

/// What a result of this spec guarantees: "samples", "samples-center" or "continuous" (contract, "What is
/// guaranteed"). Centres say nothing of the way between the samples, so that they never make it "continuous".
[[nodiscard]] std::string guarantee_of(const ProblemSpec& spec);

}  // namespace coordreq
