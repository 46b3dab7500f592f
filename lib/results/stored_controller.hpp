#pragma once

#include <string>

#include "engine/packed_pairs.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Checks that a results file (or one that others wrote in the same way) holds `/controller` over the grid of
/// the spec: its axes are the states of the spec in their order, its attribute `inputs` names the inputs in
/// theirs, and the datasets of both have the grid points, up to the noise of last digits.
/// @throws IoError; ResultsError naming the object, what was found and what was expected
void check_stored_controller(const std::string& path, const ProblemSpec& spec);

/// Reads it, after the same checks.
[[nodiscard]] PackedPairs read_stored_controller(const std::string& path, const ProblemSpec& spec);

}  // namespace coordreq
