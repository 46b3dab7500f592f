#include "model/condition_table.hpp"

#include "model/pieces.hpp"

namespace coordreq {
namespace {

RationalInterval point_interval(const Rational& point) {
  return {.lower = point, .upper = point};
}

ConditionAxis axis_of_state(const GridDimension& dimension, Sampling sampling) {
  ConditionAxis axis;
  for (std::int64_t k = 0; k < dimension.count; ++k) {
    std::vector<RationalInterval>& parts = axis.ranges.emplace_back();
    if (sampling == Sampling::centres) {
      parts.push_back(point_interval(dimension.point(k)));
      continue;
    }
    for (const Piece& piece : pieces(dimension, k))
      parts.push_back({.lower = piece.lower, .upper = piece.upper});
  }
  return axis;
}

/// By slot: states, then inputs; filled for the variables of the condition and for the last state.
std::vector<ConditionAxis> axes_of(const Program& condition, const UniformGrid& grid,
                                   const InputSpace& inputs, Sampling sampling) {
  std::vector<ConditionAxis> axes(grid.size() + inputs.size());
  axes[grid.size() - 1] = axis_of_state(grid[grid.size() - 1], sampling);
  for (const std::uint32_t slot : condition.variables()) {
    if (slot + 1 < grid.size()) axes[slot] = axis_of_state(grid[slot], sampling);
    if (slot < grid.size()) continue;
    for (const Rational& value : inputs[slot - grid.size()].values)
      axes[slot].ranges.push_back({point_interval(value)});
  }
  return axes;
}

}  // namespace

ConditionTable::ConditionTable(const Program& condition, const UniformGrid& grid, const InputSpace& inputs,
                               Sampling sampling, const Undecided& undecided, ThreadTeam& team,
                               Question question)
    : grid_(&grid),
      input_space_(&inputs),
      table_(condition, axes_of(condition, grid, inputs, sampling),
             static_cast<std::uint32_t>(grid.size() - 1), undecided, team, question),
      state_stride_(table_.strides().begin(),
                    table_.strides().begin() + static_cast<std::ptrdiff_t>(grid.size())),
      input_stride_(table_.strides().begin() + static_cast<std::ptrdiff_t>(grid.size()),
                    table_.strides().end()) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (input_stride_[i] != 0) inputs_.push_back(static_cast<std::int32_t>(i));
  }
}

std::int64_t ConditionTable::position(std::int64_t row, std::int64_t u) const {
  std::int64_t position = 0;
  for (std::size_t i = 0; i + 1 < grid_->size(); ++i) {
    if (state_stride_[i] != 0) position += grid_->index(row * grid_->row_length(), i) * state_stride_[i];
  }
  for (const std::int32_t i : inputs_) {
    const auto input = static_cast<std::size_t>(i);
    position += input_space_->index(u, input) * input_stride_[input];
  }
  return position;
}

}  // namespace coordreq
