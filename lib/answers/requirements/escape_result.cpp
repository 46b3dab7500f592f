#include "answers/requirements/escape_result.hpp"

#include "answers/step_codes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Writes an escape, sample by sample and step by step, to a result.
struct EscapeWriter {
  const AnalysisContext& context;
  const CellRequirement& asked;
  const std::vector<std::int64_t>& number_stride;
  ResultPath path = {};

  void add_sample(std::int64_t cell) {
    const UniformGrid& grid = context.abstraction->grid;
    std::int64_t number = 0;
    std::vector<double> state(grid.size());
    for (std::size_t i = 0; i < grid.size(); ++i) {
      number += grid.index(cell, i) * number_stride[i];
      state[grid.state(i)] = nearest_double(grid[i].point(grid.index(cell, i)));
    }
    path.cell.push_back(static_cast<std::uint64_t>(number));
    path.state.insert(path.state.end(), state.begin(), state.end());
    // The values are those of the process that owns the cell.
    const RowShare* const share = asked.collision_time->share();
    const bool is_own = share == nullptr || share->owner(cell / grid.row_length()) == share->ranks().rank();
    const std::int64_t own_time = is_own ? asked.collision_time->at(cell) : 0;
    const std::int64_t time = sum_of_all(share, own_time);
    path.collision_time.push_back(time == LevelMap::kTop ? kUnbounded : static_cast<std::int32_t>(time));
    path.delay.push_back(static_cast<std::int32_t>(sum_of_all(share, is_own ? asked.value_of(cell) : 0)));
  }

  void add_step(std::int64_t u) {
    const InputSpace& inputs = context.abstraction->inputs;
    for (std::size_t i = 0; i < inputs.size(); ++i)
      path.input.push_back(nearest_double(inputs[i].values[static_cast<std::size_t>(inputs.index(u, i))]));
  }
};

}  // namespace

ResultPath result_of(const EscapePath& found, const AnalysisContext& context, const CellRequirement& asked,
                     const std::vector<std::int64_t>& number_stride) {
  EscapeWriter writer{context, asked, number_stride};
  writer.path.phase = found.phases;
  writer.path.end = found.end;
  for (const std::int64_t x : found.cells) writer.add_sample(x);
  for (const std::int64_t u : found.joint_inputs) writer.add_step(u);
  for (const DomainSide& side : found.sides) {
    const ResultSide named{.state = context.abstraction->grid.state(side.dimension), .above = side.above};
    if (!writer.path.left_side || named.state < writer.path.left_side->state) writer.path.left_side = named;
  }
  return std::move(writer.path);
}

}  // namespace coordreq
