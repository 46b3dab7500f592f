#pragma once

#include <cstdint>
#include <vector>

#include "base/thread_team.hpp"
#include "model/table_shape.hpp"
#include "reach/abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// Looks at the dynamics: what each state depends on, and how its table will be kept.
[[nodiscard]] std::vector<TableShape> table_shapes(const ProblemSpec& spec);

/// Solves the dynamics for every input and parameter without building tables.
/// @returns true if every post is an exact hull. @throws SpecError as build_abstraction() does, but for
/// discrete states
///   off their grid
[[nodiscard]] bool check_dynamics(const ProblemSpec& spec);

/// Builds the finite abstraction. Each post is the exact interval hull in rational arithmetic where the
/// system is exact (contract, "Cells"), else rounded outward: never too small.
/// @throws SpecError if a discrete state's next value can be off its grid (naming state and input), if an
/// equation is
///   undefined somewhere, or if the dynamics are beyond this version
[[nodiscard]] Abstraction build_abstraction(const ProblemSpec& spec, ThreadTeam& team);

}  // namespace coordreq
