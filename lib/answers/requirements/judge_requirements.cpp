#include "answers/requirements/judge_requirements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "answers/invariance/answer.hpp"
#include "answers/layers/answer.hpp"
#include "answers/requirements/escape_result.hpp"
#include "answers/requirements/requirement.hpp"
#include "base/error.hpp"

namespace coordreq {
namespace {

/// Judges one requirement after the other.
class Judge {
 public:
  Judge(const Answers& answers, ThreadTeam& team)
      : answers_(answers),
        ground_(answers.ground),
        controller_(answers.get<Controller>()),
        team_(team),
        grid_(make_grid(ground_.spec)) {
    const UniformGrid& engine_grid = ground_.abstraction->grid;
    for (std::size_t d = 0; d < engine_grid.size(); ++d)
      number_stride_.push_back(grid_.stride(engine_grid.state(d)));
  }

  ResultRequirement judge(std::size_t r) {
    const RequirementSpec& requirement = ground_.spec.requirements[r];
    std::optional<std::size_t> partition;
    if (!requirement.invariant) partition = static_cast<std::size_t>(*requirement.partition);
    const CellVerdict verdict = judge_all_cells(r, partition);
    ResultRequirement result{.name = requirement.name,
                             .cells = static_cast<std::uint64_t>(verdict.cells),
                             .failing = static_cast<std::uint64_t>(verdict.failing),
                             .least_delay = verdict.least_delay};
    if (const std::optional<DomainSide> side = side_reached(requirement.where, grid_)) {
      result.reached_side = {.state = side->dimension, .above = side->above};
    }
    result.holds = verdict.failing == 0 && !result.reached_side;
    if (verdict.worst) result.path = path_from(*verdict.worst, partition);
    return result;
  }

 private:
  /// Null: membership in K is asked for.
  [[nodiscard]] const DelayLayers* layers_of(std::optional<std::size_t> partition) const {
    return partition ? &answers_.get<PartitionLayers>().partitions[*partition] : nullptr;
  }

  [[nodiscard]] CellVerdict judge_all_cells(std::size_t r, std::optional<std::size_t> partition) const {
    const UniformGrid& grid = ground_.abstraction->grid;
    const CellSet region = cells_of_region(ground_.spec.requirements[r].where, grid, team_);
    const CellRequirement requirement{.collision_time = controller_.collision_time,
                                      .layers = layers_of(partition),
                                      .min_delay = ground_.spec.requirements[r].min_delay.value_or(0)};
    return judge_cells(region, grid, requirement, number_stride_, team_);
  }

  [[nodiscard]] ResultPath path_from(std::int64_t cell, std::optional<std::size_t> partition) const {
    EscapeSets sets{
        .ground = &ground_, .invariance = &answers_.get<Invariance>(), .number_stride = number_stride_};
    if (partition) {
      const PartitionSpec& own = ground_.spec.coordination.partitions[*partition];
      sets.classes = input_classes(ground_.spec, ground_.abstraction->inputs, own);
      sets.layers_of = &layers_of(partition)->layers_of;
    }
    return result_of(find_escape(sets, cell), ground_, *controller_.collision_time, layers_of(partition),
                     number_stride_);
  }

  const Answers& answers_;
  const Ground& ground_;
  const Controller& controller_;
  ThreadTeam& team_;
  UniformGrid grid_;                         ///< the spec's
  std::vector<std::int64_t> number_stride_;  ///< [dimension of the engine]
};

}  // namespace

void check_regions(const ProblemSpec& spec, ThreadTeam& team) {
  const UniformGrid grid = make_grid(spec);
  for (std::size_t r = 0; r < spec.requirements.size(); ++r) {
    if (cells_of_region(spec.requirements[r].where, grid, team).count() > 0) continue;
    throw SpecError("expected a region that meets the grid, found one that meets no cell",
                    fmt::format("/requirements/{}/where", r));
  }
}

std::vector<ResultRequirement> judge_requirements(const Answers& answers, ThreadTeam& team) {
  Judge judge(answers, team);
  std::vector<ResultRequirement> result;
  for (std::size_t r = 0; r < answers.ground.spec.requirements.size(); ++r) result.push_back(judge.judge(r));
  return result;
}

}  // namespace coordreq
