#pragma once

#include <string>

#include "answers/checking/post_table.hpp"
#include "answers/checking/tally.hpp"
#include "model/uniform_grid.hpp"

namespace coordreq {

/// True if every cell of `inner` is one of `outer`, in a periodic dimension after wrapping round.
[[nodiscard]] bool holds(const GridDimension& dimension, IndexRange outer, IndexRange inner);

/// Compares a table with the verifier's own, exact one of the same state: both have to be equal in all that
/// the latter has.
/// @param what the name of the check, before that of the state
[[nodiscard]] Finding check_abstraction(const UniformGrid& grid, const InputSpace& inputs, std::size_t state,
                                        const PostTable& posts, const PostTable& claimed,
                                        const std::string& what);

}  // namespace coordreq
