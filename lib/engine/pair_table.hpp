#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/list_numbers.hpp"
#include "engine/packed_pairs.hpp"
#include "engine/row_operations.hpp"
#include "model/condition_table.hpp"

namespace coordreq {

/// Pairs of states and joint inputs that are kept: one bit row along the last state dimension for each
/// choice of the other states and the inputs in use, equal rows held once. Laid out as ConditionTable is, of
/// which some leading rows may be left out.
class PairTable {
 public:
  /// What a condition permits.
  explicit PairTable(const ConditionTable& allow);
  /// What is listed, and permitted by a condition too. It depends on all states and inputs.
  /// @param permitted by the condition; may be null: everything
  /// @param rows of the grid that it is asked for
  /// @pre `listed` is over the cells of `grid` in its order, and over all joint inputs.
  /// @pre unchecked: grid and inputs outlive this object
  PairTable(const UniformGrid& grid, const InputSpace& inputs, const PackedPairs& listed,
            const PairTable* permitted, ThreadTeam::Range rows, ThreadTeam& team);

  /// The bits at a position of the table, of those that there are.
  [[nodiscard]] ConstRow row(std::int64_t position) const {
    return rows_[ids_[static_cast<std::size_t>(position)]];
  }
  /// The bits of all cells of grid row `row` under joint input `u`.
  [[nodiscard]] ConstRow row(std::int64_t row, std::int64_t u) const {
    return this->row(positions_.of(row, u));
  }

  /// [position]: equal numbers mean equal bits.
  [[nodiscard]] const std::vector<std::uint32_t>& ids() const { return ids_; }
  [[nodiscard]] const RowPositions& positions() const { return positions_; }

 private:
  RowPositions positions_;
  ListNumbers<Word> rows_;
  std::vector<std::uint32_t> ids_;
};

/// What is said of pairs of states and joint inputs.
struct PairRules {
  std::optional<PairTable> permitted;  ///< by `allow`, which forbids all else; none: nothing is forbidden
  std::optional<PairTable> listed;  ///< of these those that a controller file lists; none: there is no file

  /// The pairs that a controller may have, or null: all.
  [[nodiscard]] const PairTable* admissible() const {
    return listed ? &*listed : permitted ? &*permitted : nullptr;
  }
};

}  // namespace coordreq
