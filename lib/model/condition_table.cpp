#include "model/condition_table.hpp"

#include "model/pieces.hpp"

namespace coordreq {
namespace {

RationalInterval point_interval(const Rational& point) {
  return {.lower = point, .upper = point};
}

ConditionAxis::Ranges ranges_of_cell(const GridDimension& dimension, std::int64_t k, Sampling sampling) {
  if (sampling == Sampling::centres) return {point_interval(dimension.point(k))};
  ConditionAxis::Ranges ranges;
  for (const Piece& piece : pieces(dimension, k))
    ranges.push_back({.lower = piece.lower, .upper = piece.upper});
  return ranges;
}

/// By slot: states, then inputs.
std::vector<ConditionAxis> axes_of(const UniformGrid& grid, const InputSpace& inputs, Sampling sampling) {
  std::vector<ConditionAxis> axes(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const GridDimension& dimension = grid[i];
    axes[grid.state(i)] = {dimension.count, [&dimension, sampling](std::int64_t k) {
                             return ranges_of_cell(dimension, k, sampling);
                           }};
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const std::vector<Rational>& values = inputs[i].values;
    axes.push_back({inputs[i].count(), [&values](std::int64_t k) -> ConditionAxis::Ranges {
                      return {point_interval(values[static_cast<std::size_t>(k)])};
                    }});
  }
  return axes;
}

}  // namespace

ConditionTable::ConditionTable(const Program& condition, const UniformGrid& grid, const InputSpace& inputs,
                               Sampling sampling, const Undecided& undecided, ThreadTeam& team,
                               Question question)
    : grid_(&grid),
      input_space_(&inputs),
      table_(condition, axes_of(grid, inputs, sampling),
             static_cast<std::uint32_t>(grid.state(grid.size() - 1)), undecided, team, question),
      input_stride_(table_.strides().begin() + static_cast<std::ptrdiff_t>(grid.size()),
                    table_.strides().end()) {
  for (std::size_t i = 0; i < grid.size(); ++i) state_stride_.push_back(table_.strides()[grid.state(i)]);
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
