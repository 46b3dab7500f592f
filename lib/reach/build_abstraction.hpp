#pragma once

#include <vector>

#include "base/thread_team.hpp"
#include "reach/abstraction.hpp"
#include "reach/table_shapes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// Builds the finite abstraction. Each post is the exact interval hull in rational arithmetic where the
/// system is exact (contract, "Cells"), else rounded outward: never too small.
/// @param shapes of table_shapes()
/// @throws SpecError if a discrete state's next value can be off its grid (naming state and input), if an
///   equation is undefined somewhere, or if the dynamics are beyond this version
[[nodiscard]] Abstraction build_abstraction(const ProblemSpec& spec, const std::vector<TableShape>& shapes,
                                            ThreadTeam& team);
[[nodiscard]] Abstraction build_abstraction(const ProblemSpec& spec, ThreadTeam& team);

}  // namespace coordreq
