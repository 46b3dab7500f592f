#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "engine/pair_table.hpp"
#include "model/condition_table.hpp"
#include "ranks/row_share.hpp"
#include "reach/abstraction.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// Adds the cells in some runs of rows that satisfy a condition over states as `abstraction.safe` requires.
/// `inner`: cells whose whole closed box provably satisfies it (see ConditionDecider), never one with a point
/// that does not. The box is widened by the measurement errors, for the true state may be that far outside of
/// the cell that was measured; on the seam of a periodic dimension both pieces of a cell count; the half of a
/// boundary cell beyond a `stop` limit does not. `center`: cells whose centre satisfies it. A condition that
/// cannot be decided counts as false.
/// @param runs ascending @param cells over the grid
void add_cells_that_satisfy(const Program& condition, const ProblemSpec& spec, const UniformGrid& grid,
                            const InputSpace& inputs, const std::vector<RowShare::Range>& runs,
                            ThreadTeam& team, CellSet& cells);
/// All cells that satisfy the condition. @param share then those in the rows held; null: there is one process
[[nodiscard]] CellSet cells_that_satisfy(const Program& condition, const ProblemSpec& spec,
                                         const UniformGrid& grid, const InputSpace& inputs, ThreadTeam& team,
                                         const RowShare* share = nullptr);
/// The cells of a set that are in another set (is_in), or are not. @param share then in the rows held; null:
/// there is one process
[[nodiscard]] CellSet subset_of(const CellSet& set, const CellSet& other, bool is_in, const RowShare* share);
/// S, contract "Safe set".
[[nodiscard]] CellSet safe_set(const ProblemSpec& spec, const Abstraction& abstraction, ThreadTeam& team);

/// A condition over pairs of states and joint inputs, with its name and JSON pointer for errors.
struct PairCondition {
  const Program& program;
  std::string label;
  std::string pointer;
};

/// The pairs that a condition permits, at grid points of states and inputs; nothing if it permits all.
/// @param share then what its own rows need; null: there is one process
/// @throws SpecError naming the first grid point where it cannot be decided (contract, "Conditions"), unless
///   a memory may be why: that counts as false
[[nodiscard]] std::optional<PairTable> permitted_pairs(const PairCondition& condition,
                                                       const ProblemSpec& spec,
                                                       const Abstraction& abstraction, ThreadTeam& team,
                                                       const RowShare* share = nullptr);

/// The pairs that `allow` permits at grid points of states and inputs, and, if there is a list, those of them
/// that are listed.
/// @param listed may be null; cells in the order of the abstraction's grid
/// @param share then what its own rows need; null: there is one process
/// @throws SpecError naming the first grid point where `allow` cannot be decided (contract, "Conditions"),
///   unless a memory may be why: that counts as false
[[nodiscard]] PairRules pair_rules(const ProblemSpec& spec, const Abstraction& abstraction, ThreadTeam& team,
                                   const PackedPairs* listed = nullptr, const RowShare* share = nullptr);

}  // namespace coordreq
