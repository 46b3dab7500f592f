#include "cell/simulate_runs.hpp"

#include <algorithm>
#include <memory>

#include "base/index.hpp"
#include "base/requires.hpp"
#include "cell/invariant_cells.hpp"
#include "model/sample_reset.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

bool is_beyond_stop(const GridDimension& dimension, const Rational& value) {
  return (traits(dimension.below).stops && value < dimension.first) ||
         (traits(dimension.above).stops && value > dimension.point(dimension.count - 1));
}

std::vector<Rational> draw_start(const UniformGrid& grid, const InvariantCells& cells, RandomStream& random) {
  for (;;) {
    const std::int64_t x = cells.draw(random);
    std::vector<Rational> state;
    bool possible = true;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const GridDimension& dimension = grid[i];
      Rational value = dimension.point(grid.index(x, i));
      if (!dimension.discrete) value += dimension.step * (random.fraction() - Rational(1) / 2);
      if (dimension.periodic()) value = reset_at_sample(dimension, value);
      possible = possible && !is_beyond_stop(dimension, value);
      state.push_back(value);
    }
    if (possible) return state;
  }
}

}  // namespace

std::vector<RunTrace> simulate_runs(const LoopProblem& problem, const RunOptions& options, ThreadTeam& team) {
  std::optional<InvariantCells> cells;
  const bool is_silent = options.loop.silent_steps.has_value();
  if (!options.start)
    cells.emplace(*problem.spec, is_silent ? problem.values.at(problem.policies[1].delay) : problem.delay());
  REQUIRES(!cells || cells->count() > 0);  // of a start that is given ClosedLoop::run() needs as much
  std::vector<std::unique_ptr<ClosedLoop>> loops(at(team.size()));
  std::vector<RunTrace> traces(at(options.runs));
  team.for_each(options.runs, 1, [&](ThreadTeam::Range range, int worker) {
    std::unique_ptr<ClosedLoop>& loop = loops[at(worker)];
    if (!loop) loop = std::make_unique<ClosedLoop>(problem, options.loop);
    for (std::int64_t r = range.begin; r < range.end; ++r) {
      const auto number = static_cast<std::uint64_t>(r);
      RandomStream random(options.loop.seed, number, RandomStream::Purpose::start);
      traces[at(r)] = loop->run(
          options.start ? *options.start : draw_start(problem.abstraction->grid, *cells, random), number);
    }
  });
  return traces;
}

}  // namespace coordreq
