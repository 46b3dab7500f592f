#include "answers/requirements/judge_requirements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "answers/invariance/answer.hpp"
#include "answers/layers/answer.hpp"
#include "answers/requirements/escape_path.hpp"
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
    const UniformGrid& grid = ground_.abstraction->grid;
    const EscapePath found = find_escape(sets, cell);
    ResultPath path{.phase = found.phases, .end = found.end};
    for (const std::int64_t x : found.cells) add_sample(x, partition, path);
    for (const std::int64_t u : found.joint_inputs) add_step(u, path);
    for (const DomainSide& side : found.sides) {
      const ResultSide named{.state = grid.state(side.dimension), .above = side.above};
      if (!path.left_side || named.state < path.left_side->state) path.left_side = named;
    }
    return path;
  }

  void add_sample(std::int64_t cell, std::optional<std::size_t> partition, ResultPath& path) const {
    std::int64_t number = 0;
    for (std::size_t i = 0; i < number_stride_.size(); ++i)
      number += ground_.abstraction->grid.index(cell, i) * number_stride_[i];
    path.cell.push_back(static_cast<std::uint64_t>(number));
    for (std::size_t i = 0; i < grid_.size(); ++i)
      path.state.push_back(nearest_double(grid_[i].point(grid_.index(number, i))));
    const std::int64_t time = controller_.collision_time->at(cell);
    path.collision_time.push_back(time == LevelMap::kTop ? DelayLayers::kUnbounded
                                                         : static_cast<std::int32_t>(time));
    path.delay.push_back(delay_of(cell, time, layers_of(partition)));
  }

  void add_step(std::int64_t u, ResultPath& path) const {
    const InputSpace& inputs = ground_.abstraction->inputs;
    for (std::size_t i = 0; i < inputs.size(); ++i)
      path.input.push_back(nearest_double(inputs[i].values[static_cast<std::size_t>(inputs.index(u, i))]));
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
