#pragma once

#include <cstdint>
#include <vector>

#include "reach/affine_post.hpp"

namespace coordreq {

/// Fills the part of the table of a tube that belongs to one choice of parameters and inputs.
/// @param rows of AffineDynamics::tube_rows()
void fill_affine_tube(const AffinePost& post, const std::vector<SampledRow>& rows, std::int64_t base,
                      TransitionTable& tube);

}  // namespace coordreq
