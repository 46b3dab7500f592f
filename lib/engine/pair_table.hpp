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

/// A set of pairs of states and joint inputs: one row of bits along the last state dimension for each choice
/// of the other states and the inputs in use, equal rows held once. Laid out like ConditionTable, perhaps
/// without rows at its beginning and end.
class PairTable {
 public:
  /// The pairs that a condition permits.
  explicit PairTable(const ConditionTable& allow);
  /// The listed pairs that are permitted too. The table depends on all states and inputs.
  /// @param permitted by a condition; null: all pairs
  /// @param rows of the grid that the table is for
  /// @pre `listed` is over the cells of `grid` in its order, and over all joint inputs.
  /// @pre unchecked: grid and inputs outlive this object
  PairTable(const UniformGrid& grid, const InputSpace& inputs, const PackedPairs& listed,
            const PairTable* permitted, ThreadTeam::Range rows, ThreadTeam& team);

  /// The bits at a position, counted from the first that the table has.
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

/// Which pairs of states and joint inputs a spec permits, and a controller file lists.
struct PairRules {
  std::optional<PairTable> permitted;  ///< by `allow`; nothing: all pairs are
  std::optional<PairTable> listed;     ///< of these, those in a controller file; nothing: there is no file

  /// The pairs that a controller may have; null: all pairs.
  [[nodiscard]] const PairTable* admissible() const {
    return listed ? &*listed : permitted ? &*permitted : nullptr;
  }
};

}  // namespace coordreq
