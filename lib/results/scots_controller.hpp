#pragma once

#include <string>

#include "engine/packed_pairs.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Reads a static controller of SCOTS v0.2 (text): the grids of states and inputs, which must be those of the
/// spec up to the noise of last digits, then for each state of its winning domain the valid inputs: any
/// number of them, as a safety game leaves, or one, as a reachability game does (a matrix of one column).
/// States and inputs are numbered with dimension 0 fastest; inputs of a spec that lists values may stand in
/// any order.
/// @throws IoError; ControllerError naming file, line and section, what was found and what was expected
[[nodiscard]] PackedPairs read_scots_controller(const std::string& path, const ProblemSpec& spec);

/// Checks what comes before the list of states.
void check_scots_controller(const std::string& path, const ProblemSpec& spec);

}  // namespace coordreq
