#pragma once

#include "answers/one_cell/explain_context.hpp"

namespace coordreq {

/// Explains the worth of sight at a cell, and where sight is missing: two cells that a class cannot tell
/// apart, in which it has to take different actions, at the end of a shortest way there. Nothing if all
/// agents see everything.
[[nodiscard]] Explained explain_blind(const ExplainContext& context);

}  // namespace coordreq
