#pragma once

#include "reach/abstraction.hpp"
#include "reach/affine_dynamics.hpp"
#include "reach/affine_part.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// The table of a state with all its lists at their lengths, to be filled: one entry for every choice of what
/// its next value depends on, as far as the abstraction is to hold them.
[[nodiscard]] TransitionTable full_layout(const SystemSpec& spec, const Dependencies& dependencies,
                                          std::size_t state, const Abstraction& abstraction);

/// full_layout() as a sum, with a term for each of summed_states(). @pre there are any
[[nodiscard]] TransitionTable sum_layout(const SystemSpec& spec, const Dependencies& dependencies,
                                         const AffinePart& part, std::size_t state, const UniformGrid& grid,
                                         const InputSpace& inputs);

}  // namespace coordreq
