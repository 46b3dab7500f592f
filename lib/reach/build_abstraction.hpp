#pragma once

#include <cstdint>
#include <vector>

#include "base/thread_team.hpp"
#include "reach/abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// The tables' dependencies and sizes, without the entries.
struct TableShape {
  std::vector<std::int32_t> states;
  std::vector<std::int32_t> inputs;
  std::vector<std::int32_t> disturbances;
  bool shift = false;  ///< as in TransitionTable
  bool sum = false;    ///< likewise; if that fails the table is in full after all
  double entries = 1;  ///< that are stored; may be beyond what an integer holds
  double bytes = 0;
};
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
