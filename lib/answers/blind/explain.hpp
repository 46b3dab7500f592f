#pragma once

#include "answers/one_cell/explain_ground.hpp"

namespace coordreq {

/// What sight is worth at a cell, and where it is missed: two cells that a class cannot tell apart, in which
/// it has to do different things, at the end of a shortest way there. Nothing if all agents see everything.
[[nodiscard]] Explained explain_blind(const ExplainGround& ground);

}  // namespace coordreq
