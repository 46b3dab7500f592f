#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "answers/blind/fibres.hpp"
#include "base/requires.hpp"
#include "base/thread_team.hpp"
#include "choices/projections.hpp"
#include "engine/cell_set.hpp"
#include "engine/level_map.hpp"

namespace coordreq {

/// Q_c^k for all k, of a class c that does not see everything (contract, section 8): the actions that are in
/// A_c(x) for all x of B_k in a fibre.
///
/// The *depth* of a cell is the greatest k with x in B_k. For each action the table has the depth of the
/// deepest cell of the fibre that lacks it: B_k shrinks, so that an action is in Q^k exactly if no cell of
/// depth k or more lacks it. One byte an action, for all k together.
struct SilentTable {
  /// Greater numbers of steps count as this one, on the safe side, since Q^k only grows with k.
  static constexpr std::int64_t kMostSteps = 64;

  std::int64_t actions = 0;
  std::vector<std::uint8_t> missing_depth;  ///< [fibre * actions + action] depth of the deepest cell that
                                            ///< lacks the action; 0: no cell of B_1 does
  std::vector<std::uint8_t> seen_depth;     ///< [fibre] depth of the deepest cell

  [[nodiscard]] std::int64_t fibres() const { return static_cast<std::int64_t>(seen_depth.size()); }
  /// Whether the action is in Q^k, which is empty if no cell of B_k is in the fibre.
  /// @pre 1 <= k. @pre unchecked: k is at most the depth that the table was made for
  [[nodiscard]] bool allows(std::int64_t fibre, std::int64_t action, std::int64_t k) const {
    REQUIRES(1 <= k);
    return seen_depth[static_cast<std::size_t>(fibre)] >= k &&
           missing_depth[static_cast<std::size_t>(fibre * actions + action)] < k;
  }
  /// A cell of B_1 is in the fibre, and no action is in A_c(x) for all of them: Q^1 is empty.
  [[nodiscard]] bool has_conflict(std::int64_t fibre) const;
};

/// [class] Nothing for a class that sees everything.
using ClassFibres = std::vector<std::optional<Fibres>>;

/// The inputs to make tables.
struct SilentSources {
  const Projections& projections;  ///< that keep masks
  const CellSet& invariant;        ///< K, without a goal that ends the task
  const ClassFibres& fibres;
};

/// [class] Tables, empty for a class that sees everything. Together.
/// @param levels of K, Z_1, Z_2, ... or of B: as DelayLayers::layers_of
/// @param deepest depths above it, and cells that are never lost, count as this depth
[[nodiscard]] std::vector<SilentTable> find_silent_tables(const SilentSources& sources,
                                                          const LevelMap& levels, std::int64_t deepest,
                                                          ThreadTeam& team);

/// B_1: for one class after the other, Z_1 without the cells that lack the action that most cells of their
/// fibre have. Together.
/// @param layers of Z
/// @param tables of the layers, for at most one step
/// @returns B_1 in own rows; nothing if it is Z_1
[[nodiscard]] std::optional<CellSet> find_common_cells(const SilentSources& sources, const LevelMap& layers,
                                                       const std::vector<SilentTable>& tables,
                                                       ThreadTeam& team);

}  // namespace coordreq
