#pragma once

#include <optional>

#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "engine/pair_table.hpp"
#include "reach/abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// S, contract "Safe set". `inner`: cells whose whole closed box provably satisfies `safe` (see
/// ConditionDecider), never one with an unsafe point. The box is widened by the measurement errors, for the
/// true state may be that far outside of the cell that was measured; on the seam of a periodic dimension both
/// parts count; the half of a boundary cell beyond a `stop` limit does not. `center`: cells whose centre
/// satisfies it. What cannot be decided counts as unsafe.
[[nodiscard]] CellSet safe_set(const ProblemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
                               ThreadTeam& team);
[[nodiscard]] inline CellSet safe_set(const ProblemSpec& spec, const Abstraction& abstraction,
                                      ThreadTeam& team) {
  return safe_set(spec, abstraction.grid, abstraction.inputs, team);
}

/// The admissible pairs: those that `allow` permits at grid points of states and inputs, and that are listed
/// if there is a list; nothing if everything is admissible.
/// @param listed may be null; cells in the order of the abstraction's grid
/// @throws SpecError naming the first grid point where `allow` cannot be decided (contract, "Conditions"),
///   unless a memory may be why: that counts as false
[[nodiscard]] std::optional<PairTable> allow_table(const ProblemSpec& spec, const Abstraction& abstraction,
                                                   ThreadTeam& team, const PackedPairs* listed = nullptr);

}  // namespace coordreq
