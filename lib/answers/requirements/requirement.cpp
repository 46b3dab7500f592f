#include "answers/requirements/requirement.hpp"

#include <algorithm>
#include <tuple>

#include "answers/goal/arrival.hpp"
#include "answers/risk/risk_levels.hpp"
#include "answers/step_codes.hpp"
#include "engine/row_operations.hpp"
#include "spec/problem_spec.hpp"
#include "spec/requirement_kind.hpp"

namespace coordreq {
namespace {

/// The key by which cells are compared; the least is the worst.
using Rank = std::tuple<std::int64_t, std::int64_t, std::int64_t>;  // of the value, collision time, number

/// The verdict of one thread.
struct Partial {
  CellVerdict verdict;
  std::int64_t least_rank = INT64_MAX;  ///< of all cells of the region
  Rank worst;
};

std::int64_t number_of(const UniformGrid& grid, std::int64_t cell, const std::vector<std::int64_t>& stride) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < stride.size(); ++i) sum += grid.index(cell, i) * stride[i];
  return sum;
}

/// Joins the verdicts of all processes. Together.
void join(Ranks& ranks, Partial& partial) {
  const auto least = [&ranks](std::int64_t value) { return ~ranks.greatest(~value); };
  partial.verdict.cells = ranks.sum(partial.verdict.cells);
  partial.verdict.failing = ranks.sum(partial.verdict.failing);
  const std::int64_t local_rank = partial.least_rank;
  partial.least_rank = least(local_rank);
  partial.verdict.worst_value = static_cast<std::int32_t>(ranks.greatest(
      local_rank == partial.least_rank ? std::int64_t{partial.verdict.worst_value} : INT64_MIN));
  // The worst cell: the least rank, then the least collision time, then the least number.
  const auto [rank, time, number] = partial.worst;
  bool is_worst = partial.verdict.worst.has_value();
  for (const std::int64_t value : {rank, time, number}) {
    const std::int64_t all = least(is_worst ? value : INT64_MAX);
    is_worst = is_worst && value == all;
  }
  const std::int64_t cell = ranks.greatest(is_worst ? *partial.verdict.worst : -1);
  partial.verdict.worst = cell < 0 ? std::nullopt : std::optional<std::int64_t>(cell);
}

}  // namespace

std::int32_t delay_of(std::int64_t cell, std::int64_t collision_time, const DelayLayers* layers) {
  if (collision_time == 0) return kOutsideSafe;
  if (collision_time != LevelMap::kTop) return kOutsideInvariant;
  if (layers == nullptr) return kUnbounded;
  const std::int64_t level = layers->layers_of.at(cell);
  return level == LevelMap::kTop ? layers->top_delay() : static_cast<std::int32_t>(level - 1);
}

std::int32_t CellRequirement::value_of(std::int64_t cell) const {
  if (kind == RequirementKind::max_risk)
    return risk_bits(risks->row(cell / risks->row_length())[cell % risks->row_length()]);
  const std::int64_t time = collision_time->at(cell);
  if (kind == RequirementKind::min_silence && time != 0) return delay_of(cell, LevelMap::kTop, layers);
  const bool is_of_goal = kind == RequirementKind::max_arrival || kind == RequirementKind::min_approach_delay;
  if (time != LevelMap::kTop || !is_of_goal) return delay_of(cell, time, layers);
  if (kind == RequirementKind::max_arrival) return arrival_at(*nearness, cell);
  return layers->layers_of.at(cell) == 0 ? kOutsideWinning : delay_of(cell, time, layers);
}

bool fails(RequirementKind kind, std::int64_t steps, std::int32_t value) {
  return value < 0 || (traits(kind).is_upper_limit ? value > steps : value < steps);
}

std::int64_t rank_of(RequirementKind kind, std::int32_t value) {
  if (value == kOutsideWinning) return -1;
  if (value < 0) return INT64_MIN + 2 + value;
  return traits(kind).is_upper_limit ? -std::int64_t{value} : std::int64_t{value};
}

CellVerdict judge_cells(const CellSet& region, const UniformGrid& grid, const CellRequirement& requirement,
                        const std::vector<std::int64_t>& number_stride, ThreadTeam& team) {
  std::vector<Partial> partials(static_cast<std::size_t>(team.size()));
  const auto look_at = [&](std::int64_t cell, Partial& partial) {
    const std::int32_t value = requirement.value_of(cell);
    const std::int64_t rank = rank_of(requirement.kind, value);
    ++partial.verdict.cells;
    if (rank < partial.least_rank) partial.verdict.worst_value = value;
    partial.least_rank = std::min(partial.least_rank, rank);
    if (!fails(requirement.kind, requirement.steps, value)) return;
    ++partial.verdict.failing;
    const std::int64_t level = requirement.collision_time->at(cell);
    const std::int64_t collision_time = level == LevelMap::kTop ? std::int64_t{kUnbounded} : level;
    if (partial.verdict.worst &&
        std::tie(rank, collision_time) > std::tie(std::get<0>(partial.worst), std::get<1>(partial.worst)))
      return;
    const Rank key(rank, collision_time, number_of(grid, cell, number_stride));
    if (partial.verdict.worst && partial.worst <= key) return;
    partial.verdict.worst = cell;
    partial.worst = key;
  };
  const RowShare* const share = requirement.collision_time->share();
  for_each_local_row(team, share, grid.rows(), 1024, [&](ThreadTeam::Range range, int worker) {
    Partial& partial = partials[static_cast<std::size_t>(worker)];
    for (std::int64_t r = range.begin; r < range.end; ++r) {
      for_each_bit(region.row(r),
                   [&](std::int64_t column) { look_at(r * grid.row_length() + column, partial); });
    }
  });
  Partial all;
  for (const Partial& partial : partials) {
    all.verdict.cells += partial.verdict.cells;
    all.verdict.failing += partial.verdict.failing;
    if (partial.least_rank < all.least_rank) all.verdict.worst_value = partial.verdict.worst_value;
    all.least_rank = std::min(all.least_rank, partial.least_rank);
    if (!partial.verdict.worst || (all.verdict.worst && all.worst <= partial.worst)) continue;
    all.verdict.worst = partial.verdict.worst;
    all.worst = partial.worst;
  }
  if (share != nullptr) join(share->ranks(), all);
  return all.verdict;
}

}  // namespace coordreq
