#pragma once

#include "base/archive.hpp"
#include "reach/abstraction.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Saves the tables of an abstraction, or loads those that were saved, state by state. Their sizes are those
/// that the spec gives them.
/// @pre when loading, grid and inputs are those of make_grid() and make_input_space(); when saving, the
/// states may be arranged in another order, and rows joined
void serialise(Archive& archive, const SystemSpec& spec, Abstraction& abstraction);

}  // namespace coordreq
