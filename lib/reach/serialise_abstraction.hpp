#pragma once

#include "base/archive.hpp"
#include "reach/abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// Saves the tables of an abstraction, or loads those that were saved. Their sizes are those that the spec
/// gives them. REQUIRES: grid and inputs are the spec's; when saving, rows may be joined.
void serialise(Archive& archive, const ProblemSpec& spec, Abstraction& abstraction);

}  // namespace coordreq
