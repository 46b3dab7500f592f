#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "expression/truth_table.hpp"
#include "model/row_positions.hpp"

namespace coordreq {

/// Where the variables of a condition stand.
enum class Sampling : std::uint8_t {
  centres,  ///< grid points
  /// The whole closed cell of each state, widened by its measurement error and cut at the seam of a periodic
  /// dimension (pieces()); grid points of inputs. The condition has to hold on all pieces to be true. That is
  /// every true state that may be measured in the cell; so a requirement on a region asks this too (undecided
  /// counts as true): of all cells that may be measured while the state is in the region.
  closed_cells,
};

/// The values of states and inputs, by slot. @pre unchecked: grid and inputs outlive the axes.
/// @param leading indices of the first dimension, or all
[[nodiscard]] std::vector<ConditionAxis> condition_axes(
    const UniformGrid& grid, const InputSpace& inputs, Sampling sampling,
    std::optional<ThreadTeam::Range> leading = std::nullopt);
/// Axes of the condition `allow`: grid points, and then each state once more as the whole cell, which
/// memories are evaluated (ControllerSpec::allow).
[[nodiscard]] std::vector<ConditionAxis> allow_axes(const UniformGrid& grid, const InputSpace& inputs,
                                                    std::optional<ThreadTeam::Range> leading = std::nullopt);

/// The truth of a condition on the grid, tabulated by only the states and inputs that it depends on. The
/// condition numbers variables as the spec does; all else here is about dimensions of the grid.
///
/// One bit row along the last dimension for each choice of the other states and inputs in use, so that
/// rows serve all the cells that differ only in what the condition does not depend on.
class ConditionTable {
 public:
  using Undecided = TruthTable::Undecided;

  /// @param undecided and @param question as for TruthTable
  /// @param leading indices of the first dimension, or all; no row with another one may be read
  /// @pre the rows of the grid run along its last dimension, and `leading` is all if that is the first one
  /// too. @pre unchecked: grid and inputs outlive this object
  ConditionTable(const Program& condition, const UniformGrid& grid, const InputSpace& inputs,
                 Sampling sampling, const Undecided& undecided, ThreadTeam& team,
                 Question question = Question::truth,
                 std::optional<ThreadTeam::Range> leading = std::nullopt);
  /// The table of the condition `allow`, see allow_axes().
  ConditionTable(const Program& allow, const UniformGrid& grid, const InputSpace& inputs,
                 const Undecided& undecided, ThreadTeam& team,
                 std::optional<ThreadTeam::Range> leading = std::nullopt);

  /// The bits of all cells of grid row `row` under joint input `u` (any u if no input is in use).
  [[nodiscard]] std::span<const TruthTable::Word> row(std::int64_t row, std::int64_t u) const {
    return table_.row(positions_.of(row, u));
  }
  [[nodiscard]] const RowPositions& positions() const { return positions_; }
  /// The rows by position.
  [[nodiscard]] const TruthTable& table() const { return table_; }

 private:
  void find_positions(std::optional<ThreadTeam::Range> leading);

  TruthTable table_;
  RowPositions positions_;
};

}  // namespace coordreq
