#pragma once

#include <cstdint>
#include <vector>

#include "answers/risk/expected_risk.hpp"
#include "base/thread_team.hpp"
#include "engine/row_engine.hpp"

namespace coordreq {

/// E_q V of all cells, as levels for a PostReader: in 32 bits one map for each different E_q, in 64 bits one
/// map for one E_q at a time.
///
/// Of several processes each computes the rows that it owns, and takes in its ghost rows.
template <class Level>
class ExpectedLevels {
 public:
  /// Levels of 32 bits: one map for each E_q; of 64: one for all.
  /// @pre unchecked: both outlive this object.
  ExpectedLevels(const RowEngine& engine, const ExpectedRisks& expected);

  /// The map of an E_q.
  [[nodiscard]] const LevelRows<Level>& of(std::size_t number) const {
    return levels_[levels_.size() == 1 ? 0 : number];
  }
  /// [row] Whether the last update() has changed the row.
  [[nodiscard]] const std::vector<std::uint8_t>& changed(std::size_t number) const {
    return changed_[number];
  }

  /// Brings all maps up to date. Together. @param risks [mode] V; the first time in all rows held
  /// @param changed [mode][row] whether V has changed since the last call; not read in the first
  /// @returns whether any row of any map has changed, of any process
  bool update(const std::vector<LevelRows<std::uint32_t>>& risks,
              const std::vector<std::vector<std::uint8_t>>& changed, ThreadTeam& team);

  /// Makes the map that of one E_q. Together.
  void load(std::size_t number, const std::vector<LevelRows<std::uint32_t>>& risks, ThreadTeam& team);

 private:
  void find_rows(std::size_t number, const std::vector<LevelRows<std::uint32_t>>& risks,
                 const std::vector<RowShare::Range>& runs,
                 const std::vector<std::vector<std::uint8_t>>* changed, ThreadTeam& team);
  void exchange(std::size_t number);
  [[nodiscard]] LevelRows<Level>& levels_of(std::size_t number) {
    return levels_[levels_.size() == 1 ? 0 : number];
  }

  const RowEngine& engine_;
  const ExpectedRisks& expected_;
  std::vector<LevelRows<Level>> levels_;
  std::vector<std::vector<std::uint8_t>> changed_;  ///< [number][row]
  bool is_new_ = true;
};

extern template class ExpectedLevels<std::uint32_t>;
extern template class ExpectedLevels<std::uint64_t>;

}  // namespace coordreq
