#include "model/condition_table.hpp"

#include <utility>

#include "base/requires.hpp"
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

}  // namespace

std::vector<ConditionAxis> condition_axes(const UniformGrid& grid, const InputSpace& inputs,
                                          Sampling sampling, std::optional<ThreadTeam::Range> leading) {
  std::vector<ConditionAxis> axes(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const GridDimension& dimension = grid[i];
    const ThreadTeam::Range range = i == 0 && leading ? *leading : ThreadTeam::Range{0, dimension.count};
    axes[grid.state(i)] = {range.end - range.begin,
                           [&dimension, sampling, first = range.begin](std::int64_t k) {
                             return ranges_of_cell(dimension, first + k, sampling);
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

std::vector<ConditionAxis> allow_axes(const UniformGrid& grid, const InputSpace& inputs,
                                      std::optional<ThreadTeam::Range> leading) {
  std::vector<ConditionAxis> axes = condition_axes(grid, inputs, Sampling::centres, leading);
  std::vector<ConditionAxis> cells = condition_axes(grid, inputs, Sampling::closed_cells, leading);
  for (std::uint32_t i = 0; i < grid.size(); ++i) {
    cells[i].follows = i;
    axes.push_back(std::move(cells[i]));
  }
  return axes;
}

ConditionTable::ConditionTable(const Program& condition, const UniformGrid& grid, const InputSpace& inputs,
                               Sampling sampling, const Undecided& undecided, ThreadTeam& team,
                               Question question, std::optional<ThreadTeam::Range> leading)
    : table_(condition, condition_axes(grid, inputs, sampling, leading),
             static_cast<std::uint32_t>(grid.state(grid.size() - 1)), undecided, team, question),
      positions_{.grid = &grid, .input_space = &inputs} {
  find_positions(leading);
}

ConditionTable::ConditionTable(const Program& allow, const UniformGrid& grid, const InputSpace& inputs,
                               const Undecided& undecided, ThreadTeam& team,
                               std::optional<ThreadTeam::Range> leading)
    : table_(allow, allow_axes(grid, inputs, leading),
             static_cast<std::uint32_t>(grid.state(grid.size() - 1)), undecided, team),
      positions_{.grid = &grid, .input_space = &inputs} {
  find_positions(leading);
}

void ConditionTable::find_positions(std::optional<ThreadTeam::Range> leading) {
  const UniformGrid& grid = *positions_.grid;
  REQUIRES(grid.across() + 1 == grid.size());
  REQUIRES(!leading || grid.size() > 1 || (leading->begin == 0 && leading->end == grid[0].count));
  const InputSpace& inputs = *positions_.input_space;
  const std::vector<std::int64_t>& strides = table_.strides();
  for (std::size_t i = 0; i < grid.size(); ++i) positions_.state_stride.push_back(strides[grid.state(i)]);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    positions_.input_stride.push_back(strides[grid.size() + i]);
    if (positions_.input_stride[i] != 0) positions_.inputs.push_back(static_cast<std::int32_t>(i));
  }
  if (leading) positions_.before = leading->begin * positions_.state_stride.front();
}

}  // namespace coordreq
