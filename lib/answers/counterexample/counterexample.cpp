#include "answers/counterexample/counterexample.hpp"

#include <algorithm>
#include <utility>

#include "answers/counterexample/path_run.hpp"
#include "answers/step_codes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Start = std::optional<std::vector<Rational>>;

/// The most looks at joint inputs by which the system itself could go on.
constexpr std::int64_t kMostLooks = 200'000;

/// Finds which of equal steps to take from a cell on.
PathSearch::Choices find_choices(std::int64_t cell, PathSearch& search, PathRun& run) {
  run.begin_path(cell);
  const FollowedState here = *run.position();
  PathSearch::Choices choices = search.find(run);
  run.go_to(here);
  return choices;
}

CellPath find_path(const CounterexampleProblem& problem, std::int64_t cell, const Start& start) {
  PathRun run(problem);
  run.start_at(cell, start);
  PathSearch search(kMostLooks);
  const PathSearch::Choices choices = find_choices(cell, search, run);
  for (std::size_t k = 0; run.goes_on(); ++k) run.step(k < choices.size() ? choices[k] : 0);
  return std::move(run.path());
}

/// The nominal simulation. @returns as ResultPath::seen
std::int32_t simulate_nominally(const CounterexampleProblem& problem, std::int64_t cell, const Start& start) {
  PathRun run(problem);
  run.start_at(cell, start);
  PathSearch search(kMostLooks);
  std::optional<PathPhase> first;
  PathSearch::Choices choices;
  std::size_t next = 0;
  const std::int64_t inputs = problem.context->abstraction->inputs.count();
  const std::int64_t most = std::clamp<std::int64_t>(1'000'000 / inputs, 20, 1000);
  for (std::int32_t steps = 1; steps <= most; ++steps) {
    if (next == choices.size()) {
      choices = find_choices(cell, search, run);
      next = 0;
    }
    run.begin_path(cell);
    run.step_alone(next < choices.size() ? choices[next++] : 0);
    const Reached& reached = run.reached();
    const CellPath& path = run.path();
    if (path.joint_inputs.empty() || !reached.successor.is_known) break;
    if (!first) first = path.phases.front();
    const bool is_inside = *first == PathPhase::independent || *first == PathPhase::silent;
    const bool is_kept = is_inside ? reached.is_inside : reached.is_safe;
    if (!is_kept || path.end == PathEnd::not_allowed) return steps;
    if (!is_inside && reached.is_inside) break;  // the actions outside lead it back inside
    if (reached.successor.kind != Location::Kind::cell) break;
    run.advance();
    cell = reached.successor.cell;
  }
  return ResultPath::kNotLeft;
}

/// Writes a path, sample by sample and step by step, to a result.
struct PathWriter {
  const CounterexampleProblem& problem;
  ResultPath path = {};

  void add_sample(std::int64_t cell) {
    const UniformGrid& grid = problem.context->abstraction->grid;
    std::int64_t number = 0;
    std::vector<double> state(grid.size());
    for (std::size_t i = 0; i < grid.size(); ++i) {
      number += grid.index(cell, i) * problem.number_stride[i];
      state[grid.state(i)] = nearest_double(grid[i].point(grid.index(cell, i)));
    }
    path.cell.push_back(static_cast<std::uint64_t>(number));
    path.state.insert(path.state.end(), state.begin(), state.end());
    // The values are those of the process that owns the cell.
    const RowShare* const share = problem.context->shared_rows();
    const bool is_held = share == nullptr || share->owner(cell / grid.row_length()) == share->ranks().rank();
    const std::int64_t time = sum_of_all(share, is_held ? problem.collision_time(cell) : 0);
    path.collision_time.push_back(time == INT64_MAX ? kUnbounded : static_cast<std::int32_t>(time));
    path.delay.push_back(static_cast<std::int32_t>(sum_of_all(share, is_held ? problem.value(cell) : 0)));
  }

  void add_step(std::int64_t u) {
    const InputSpace& inputs = problem.context->abstraction->inputs;
    for (std::size_t i = 0; i < inputs.size(); ++i)
      path.input.push_back(nearest_double(inputs[i].values[static_cast<std::size_t>(inputs.index(u, i))]));
  }
};

ResultPath result_of(const CellPath& path, const CounterexampleProblem& problem) {
  PathWriter writer{problem};
  writer.path.phase = path.phases;
  writer.path.end = path.end;
  for (const std::int64_t x : path.cells) writer.add_sample(x);
  for (const std::int64_t u : path.joint_inputs) writer.add_step(u);
  for (const DomainSide& side : path.sides) {
    const ResultSide named{.state = problem.context->abstraction->grid.state(side.dimension),
                           .above = side.above};
    if (!writer.path.left_side || named.state < writer.path.left_side->state) writer.path.left_side = named;
  }
  return std::move(writer.path);
}

}  // namespace

StepsFrom steps_from(const LevelMap& levels) {
  return [&levels](std::int64_t cell) {
    const std::int64_t level = levels.at(cell);
    return level == LevelMap::kTop ? INT64_MAX : level;
  };
}

IsCell is_in(const CellSet& set) {
  return [&set](std::int64_t cell) { return set.test(cell); };
}

CounterexamplePhase independent_phase(const CounterexampleProblem& problem, StepsFrom steps) {
  return {.choices = PathPhase::independent,
          .holds = problem.invariant,
          .steps = std::move(steps),
          .after = problem.collision_time};
}

CounterexamplePhase evasive_phase(const CounterexampleProblem& problem) {
  return {.choices = PathPhase::evasive,
          .holds = [time = problem.collision_time](std::int64_t cell) { return time(cell) > 0; },
          .steps = problem.collision_time};
}

CounterexamplePhase silent_phase(StepsFrom steps, StepsFrom after) {
  return {.choices = PathPhase::silent,
          .holds = [steps](std::int64_t cell) { return steps(cell) > 0; },
          .steps = steps,
          .after = std::move(after)};
}

ResultPath find_counterexample(const CounterexampleProblem& problem, std::int64_t cell, const Start& start) {
  ResultPath path = result_of(find_path(problem, cell, start), problem);
  if (problem.inside && path.steps() > 0) path.seen = simulate_nominally(problem, cell, start);
  return path;
}

}  // namespace coordreq
