#pragma once

#include <string>

#include "spec/coordination_spec.hpp"
#include "spec/scope.hpp"

// The probabilities of a network.
namespace coordreq {

/// A number or a list of the least and the greatest one. @throws SpecError if it is not within [0, 1]
[[nodiscard]] ProbabilityRange read_probability(const Scope& scope, const JsonDocument::Node& node);

/// Narrows the ranges of all transitions to what they can be while those of each mode are 1 in sum, and drops
/// transitions that cannot happen. Nothing to do for a network without numbers.
/// @param pointer where the numbers stand
/// @throws SpecError if those of a mode cannot be 1 in sum
void settle_probabilities(NetworkSpec& network, const std::string& pointer);

}  // namespace coordreq
