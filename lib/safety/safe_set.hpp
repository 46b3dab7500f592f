#pragma once

#include <optional>

#include "abstraction/abstraction.hpp"
#include "base/thread_team.hpp"
#include "bitset/cell_set.hpp"
#include "safety/condition_table.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// S, contract "Safe set". `inner`: cells whose whole closed box provably satisfies `safe`; never one with an
/// unsafe point. `center`: cells whose centre does. What cannot be decided counts as unsafe.
[[nodiscard]] CellSet safe_set(const ProblemSpec& spec, const Abstraction& abstraction, ThreadTeam& team);

/// `allow` at all grid points of states and inputs; nothing if everything is allowed.
/// @throws SpecError naming the first grid point where it cannot be decided (contract, "Conditions")
[[nodiscard]] std::optional<ConditionTable> allow_table(const ProblemSpec& spec,
                                                        const Abstraction& abstraction, ThreadTeam& team);

}  // namespace coordreq
