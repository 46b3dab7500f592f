#include "answers/requirements/requirement.hpp"

#include <algorithm>
#include <tuple>

#include "engine/row_operations.hpp"

namespace coordreq {
namespace {

/// What cells are compared by; the least is the worst.
using Rank = std::tuple<std::int32_t, std::int64_t, std::int64_t>;  // delay, collision time, number

/// What one thread has found.
struct Part {
  CellVerdict verdict;
  Rank worst;
};

std::int64_t number_of(const UniformGrid& grid, std::int64_t cell, const std::vector<std::int64_t>& stride) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < stride.size(); ++i) sum += grid.index(cell, i) * stride[i];
  return sum;
}

void add(CellVerdict& all, const CellVerdict& part) {
  all.cells += part.cells;
  all.failing += part.failing;
  all.least_delay = std::min(all.least_delay, part.least_delay);
}

}  // namespace

std::int32_t delay_of(std::int64_t cell, std::int64_t collision_time, const DelayLayers* layers) {
  if (collision_time == 0) return DelayLayers::kOutsideSafe;
  if (collision_time != LevelMap::kTop) return DelayLayers::kOutsideInvariant;
  if (layers == nullptr) return DelayLayers::kUnbounded;
  const std::int64_t level = layers->layers_of.at(cell);
  return level == LevelMap::kTop ? layers->top_delay() : static_cast<std::int32_t>(level - 1);
}

CellVerdict judge_cells(const CellSet& region, const UniformGrid& grid, const CellRequirement& requirement,
                        const std::vector<std::int64_t>& number_stride, ThreadTeam& team) {
  std::vector<Part> parts(static_cast<std::size_t>(team.size()));
  const auto look_at = [&](std::int64_t cell, Part& part) {
    const std::int64_t collision_time = requirement.collision_time->at(cell);
    const std::int32_t delay = delay_of(cell, collision_time, requirement.layers);
    ++part.verdict.cells;
    part.verdict.least_delay = std::min(part.verdict.least_delay, delay);
    if (delay >= 0 && delay >= requirement.min_delay) return;
    ++part.verdict.failing;
    if (part.verdict.worst &&
        std::tie(delay, collision_time) > std::tie(std::get<0>(part.worst), std::get<1>(part.worst)))
      return;
    const Rank rank(delay, collision_time, number_of(grid, cell, number_stride));
    if (part.verdict.worst && part.worst <= rank) return;
    part.verdict.worst = cell;
    part.worst = rank;
  };
  team.for_each(grid.rows(), 1024, [&](ThreadTeam::Range range, int worker) {
    Part& part = parts[static_cast<std::size_t>(worker)];
    for (std::int64_t r = range.begin; r < range.end; ++r) {
      for_each_bit(region.row(r),
                   [&](std::int64_t column) { look_at(r * grid.row_length() + column, part); });
    }
  });
  CellVerdict verdict;
  const Part* worst = nullptr;
  for (const Part& part : parts) {
    add(verdict, part.verdict);
    if (part.verdict.worst && (worst == nullptr || part.worst < worst->worst)) worst = &part;
  }
  if (worst != nullptr) verdict.worst = worst->verdict.worst;
  return verdict;
}

}  // namespace coordreq
