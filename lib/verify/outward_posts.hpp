#pragma once

#include <optional>

#include "base/thread_team.hpp"
#include "verify/post_table.hpp"

namespace coordreq {

/// The table of a state by enclosures in outward rounded doubles: of a map by MapBounds, of a flow by
/// FlowBounds. What follows its own present value is enclosed once for all its cells. Where that is not
/// inside the claimed table it is tried again with smaller boxes.
/// @param claimed of the same shape
/// @returns nothing where these do not do: limits that stop a state, jumps in a flow, no enclosure found
[[nodiscard]] std::optional<PostTable> outward_posts(const ProblemSpec& spec, const UniformGrid& grid,
                                                     const InputSpace& inputs, std::size_t state,
                                                     const PostTable& claimed, ThreadTeam& team);

}  // namespace coordreq
