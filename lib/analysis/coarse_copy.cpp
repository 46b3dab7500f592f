#include "analysis/coarse_copy.hpp"

#include <algorithm>

#include "reach/table_shapes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

Rational rational(std::int64_t number) {
  return Rational(mpz_class(static_cast<long>(number)));
}

/// What K and the layers of a partition rest on.
ProblemSpec part_of(const ProblemSpec& spec, std::size_t partition) {
  ProblemSpec part{static_cast<const SystemSpec&>(spec)};
  for (AgentSpec& agent : part.agents) agent.sees.reset();
  part.safe = spec.safe;
  if (spec.ends_at_goal()) {
    part.goal = spec.goal;
    part.goal_then = spec.goal_then;
  }
  part.controller = spec.controller;
  part.coordination = {.partitions = {spec.coordination.partitions[partition]}, .max_delay = 1};
  return part;
}

}  // namespace

void regrid(StateSpec& state, const Rational& factor) {
  GridSpec& grid = state.grid;
  if (state.discrete || factor == 1) return;
  if (state.below == Outside::periodic) {
    const std::int64_t count = floor_to_int(rational(grid.count) / factor + Rational(1, 2));
    if (count < 2) return;
    grid.step = (state.upper - state.lower) / rational(count);
    grid.count = count;
    return;
  }
  const Rational step = grid.step * factor;
  const Rational first = grid.first - step * rational(floor_to_int((grid.first - state.lower) / step));
  const std::int64_t count = floor_to_int((state.upper - first) / step) + 1;
  if (count >= 2) grid = {first, step, count};
}

void coarsen(ProblemSpec& spec, std::int64_t factor) {
  constexpr std::int64_t kFewPoints = 4;
  for (StateSpec& state : spec.states)
    regrid(state, rational(std::clamp<std::int64_t>(state.grid.count / kFewPoints, 1, factor)));
}

std::optional<CoarseCopy> coarse_copy(const ProblemSpec& spec, std::size_t partition, std::int64_t most_cells,
                                      double most_entries) {
  // Which conditions are undecided, and so the values of memories, follows from the grid.
  if (spec.controller.file || !spec.memory.empty()) return std::nullopt;
  for (std::int64_t factor = 1; factor <= 4096; factor = factor < 4 ? factor + 1 : factor * 3 / 2) {
    CoarseCopy copy{.spec = part_of(spec, partition), .factor = factor};
    coarsen(copy.spec, factor);
    if (copy.spec.cells() <= most_cells && entries_of(table_shapes(copy.spec)) <= most_entries) return copy;
  }
  return std::nullopt;
}

}  // namespace coordreq
