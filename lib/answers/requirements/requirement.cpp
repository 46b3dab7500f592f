#include "answers/requirements/requirement.hpp"

#include <algorithm>
#include <tuple>

#include "answers/goal/arrival.hpp"
#include "answers/goal/fields.hpp"
#include "engine/row_operations.hpp"

namespace coordreq {
namespace {

/// What cells are compared by; the least is the worst.
using Rank = std::tuple<std::int64_t, std::int64_t, std::int64_t>;  // of the value, collision time, number

/// What one thread has found.
struct Part {
  CellVerdict verdict;
  std::int64_t least_rank = INT64_MAX;  ///< of all cells
  Rank worst;
};

std::int64_t number_of(const UniformGrid& grid, std::int64_t cell, const std::vector<std::int64_t>& stride) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < stride.size(); ++i) sum += grid.index(cell, i) * stride[i];
  return sum;
}

}  // namespace

std::int32_t delay_of(std::int64_t cell, std::int64_t collision_time, const DelayLayers* layers) {
  if (collision_time == 0) return DelayLayers::kOutsideSafe;
  if (collision_time != LevelMap::kTop) return DelayLayers::kOutsideInvariant;
  if (layers == nullptr) return DelayLayers::kUnbounded;
  const std::int64_t level = layers->layers_of.at(cell);
  return level == LevelMap::kTop ? layers->top_delay() : static_cast<std::int32_t>(level - 1);
}

std::int32_t CellRequirement::value_of(std::int64_t cell) const {
  const std::int64_t time = collision_time->at(cell);
  const bool is_of_goal = kind == RequirementKind::max_arrival || kind == RequirementKind::min_approach_delay;
  if (time != LevelMap::kTop || !is_of_goal) return delay_of(cell, time, layers);
  if (kind == RequirementKind::max_arrival) return arrival_at(*nearness, cell);
  return layers->layers_of.at(cell) == 0 ? kOutsideWinning : delay_of(cell, time, layers);
}

bool fails(RequirementKind kind, std::int64_t steps, std::int32_t value) {
  return value < 0 || (kind == RequirementKind::max_arrival ? value > steps : value < steps);
}

std::int64_t rank_of(RequirementKind kind, std::int32_t value) {
  if (value == kOutsideWinning) return -1;
  if (value < 0) return INT64_MIN + 2 + value;
  return kind == RequirementKind::max_arrival ? -std::int64_t{value} : std::int64_t{value};
}

CellVerdict judge_cells(const CellSet& region, const UniformGrid& grid, const CellRequirement& requirement,
                        const std::vector<std::int64_t>& number_stride, ThreadTeam& team) {
  std::vector<Part> parts(static_cast<std::size_t>(team.size()));
  const auto look_at = [&](std::int64_t cell, Part& part) {
    const std::int32_t value = requirement.value_of(cell);
    const std::int64_t rank = rank_of(requirement.kind, value);
    ++part.verdict.cells;
    if (rank < part.least_rank) part.verdict.worst_value = value;
    part.least_rank = std::min(part.least_rank, rank);
    if (!fails(requirement.kind, requirement.steps, value)) return;
    ++part.verdict.failing;
    const std::int64_t collision_time = requirement.collision_time->at(cell);
    if (part.verdict.worst &&
        std::tie(rank, collision_time) > std::tie(std::get<0>(part.worst), std::get<1>(part.worst)))
      return;
    const Rank own(rank, collision_time, number_of(grid, cell, number_stride));
    if (part.verdict.worst && part.worst <= own) return;
    part.verdict.worst = cell;
    part.worst = own;
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
  std::int64_t least_rank = INT64_MAX;
  for (const Part& part : parts) {
    verdict.cells += part.verdict.cells;
    verdict.failing += part.verdict.failing;
    if (part.least_rank < least_rank) verdict.worst_value = part.verdict.worst_value;
    least_rank = std::min(least_rank, part.least_rank);
    if (part.verdict.worst && (worst == nullptr || part.worst < worst->worst)) worst = &part;
  }
  if (worst != nullptr) verdict.worst = worst->verdict.worst;
  return verdict;
}

}  // namespace coordreq
