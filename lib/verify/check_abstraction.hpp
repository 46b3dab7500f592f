#pragma once

#include <string>

#include "model/uniform_grid.hpp"
#include "spec/problem_spec.hpp"
#include "verify/post_table.hpp"
#include "verify/tally.hpp"

namespace coordreq {

/// True if every cell of `inner` is one of `outer`, in a periodic dimension after wrapping round.
[[nodiscard]] bool holds(const GridDimension& dimension, IndexRange outer, IndexRange inner);

/// Compares a table with the verifier's own of the same state. An exact one has to be equal; an enclosure has
/// to be inside the claimed range, else that is not proven to hold all that can happen.
/// @param what the name of the check, before that of the state
[[nodiscard]] Finding check_abstraction(const GridDimension& dimension, const PostTable& own,
                                        const PostTable& claimed, const std::string& what);

}  // namespace coordreq
