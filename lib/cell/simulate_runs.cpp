#include "cell/simulate_runs.hpp"

#include <algorithm>
#include <memory>

#include "base/index.hpp"
#include "model/sample_reset.hpp"

namespace coordreq {
namespace {

/// Draws from the cells of K without a list of them: counts by block, then a walk through one block.
class InvariantCells {
 public:
  explicit InvariantCells(std::span<const std::int32_t> delay) : delay_(delay) {
    for (std::size_t begin = 0; begin < delay.size(); begin += kBlock) {
      before_.push_back(count_);
      const std::size_t end = std::min(begin + kBlock, delay.size());
      for (std::size_t x = begin; x < end; ++x) count_ += delay[x] >= 0 ? 1U : 0U;
    }
  }

  [[nodiscard]] std::int64_t draw(RandomStream& random) const {
    const std::uint64_t wanted = random.below(count_);
    const auto block = std::upper_bound(before_.begin(), before_.end(), wanted) - before_.begin() - 1;
    std::uint64_t passed = before_[at(block)];
    std::size_t x = at(block) * kBlock;
    while (delay_[x] < 0 || passed++ < wanted) ++x;
    return static_cast<std::int64_t>(x);
  }

 private:
  static constexpr std::size_t kBlock = 4096;
  std::span<const std::int32_t> delay_;
  std::vector<std::uint64_t> before_;  ///< cells of K before each block
  std::uint64_t count_ = 0;
};

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
  if (!options.start) cells.emplace(problem.delay);
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
