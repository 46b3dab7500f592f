#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "model/input_space.hpp"
#include "model/sharp_condition.hpp"
#include "model/uniform_grid.hpp"
#include "numeric/truth.hpp"
#include "spec/problem_spec.hpp"

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

/// The truth of a condition over the grid, tabulated over only the states and inputs that it depends on. The
/// condition numbers variables as the spec does; all else here is about dimensions of the grid.
///
/// One bit row along the last state dimension for each choice of the other states and inputs in use, so that
/// rows serve all the cells that differ only in what the condition does not depend on.
class ConditionTable {
 public:
  /// @param treat_as_true called for a case left undecided, with the indices by slot; its result counts (a
  ///   callback may also throw)
  using Undecided = std::function<bool(const std::vector<std::int64_t>& indices)>;

  /// @param question `everywhere` saves work where `undecided` only ever answers false
  ConditionTable(const Program& condition, const UniformGrid& grid, const InputSpace& inputs,
                 Sampling sampling, const Undecided& undecided, ThreadTeam& team,
                 Question question = Question::truth);

  /// The bits of all cells of grid row `row` under joint input `u` (any u if no input is in use).
  [[nodiscard]] std::span<const CellSet::Word> row(std::int64_t row, std::int64_t u) const;
  /// Position of that row in the table: equal positions mean equal bits.
  [[nodiscard]] std::int64_t position(std::int64_t row, std::int64_t u) const;
  /// Index of dimension i in row `position` of this table. REQUIRES: it is in use, and not the last one.
  [[nodiscard]] std::int64_t state_index(std::int64_t position, std::size_t i) const {
    return position / state_stride_[i] % (*grid_)[i].count;
  }
  [[nodiscard]] std::int64_t input_index(std::int64_t position, std::size_t i) const {
    return position / input_stride_[i] % (*input_space_)[i].count();
  }
  [[nodiscard]] const CellSet& bits() const { return bits_; }
  [[nodiscard]] const UniformGrid& grid() const { return *grid_; }
  [[nodiscard]] const InputSpace& input_space() const { return *input_space_; }

  [[nodiscard]] const std::vector<std::int32_t>& states() const {
    return states_;
  }  ///< without the last dimension
  [[nodiscard]] const std::vector<std::int32_t>& inputs() const { return inputs_; }
  [[nodiscard]] const std::vector<std::int64_t>& state_stride() const { return state_stride_; }
  [[nodiscard]] const std::vector<std::int64_t>& input_stride() const { return input_stride_; }

 private:
  const UniformGrid* grid_;
  const InputSpace* input_space_;
  std::vector<std::int32_t> states_;
  std::vector<std::int32_t> inputs_;
  std::vector<std::int64_t> state_stride_;  ///< in rows of the table; 0 where not in use
  std::vector<std::int64_t> input_stride_;
  CellSet bits_;

  /// The rows where the atoms of the condition (or of its negation) prove it, laid out as this table; empty
  /// if it has no atoms of its own.
  [[nodiscard]] CellSet proven_by_atoms(const Program& condition, bool negated, Sampling sampling,
                                        ThreadTeam& team) const;
};

}  // namespace coordreq
