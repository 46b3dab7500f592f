#include "cell/file_sets.hpp"

#include <algorithm>

#include "answers/invariance/safe_tubes.hpp"
#include "answers/layers/stored_partition.hpp"
#include "answers/paths.hpp"
#include "answers/step_codes.hpp"
#include "base/index.hpp"
#include "cell/cell_controller.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// The cells for which a test holds.
template <class IsMember>
CellSet cells_with(const UniformGrid& grid, const IsMember& is_member) {
  CellSet set(grid.rows(), grid.row_length());
  for (std::int64_t cell = 0; cell < grid.cells(); ++cell) {
    if (is_member(cell)) set.set(cell);
  }
  return set;
}

}  // namespace

bool FileSteps::is_lower_bound(std::int64_t cell) const {
  return deepest != kUnbounded && steps[at(cell)] == deepest;
}

bool FileSteps::is_bounded(std::int64_t cell) const {
  return steps[at(cell)] != kUnbounded && !is_lower_bound(cell);
}

StepsFrom FileSteps::layers() const {
  return [this](std::int64_t cell) {
    return is_bounded(cell) ? std::max<std::int64_t>(steps[at(cell)] + 1, 0) : INT64_MAX;
  };
}

double FileSets::bytes(const ResultsReader& results) {
  double of_cell = 2 * sizeof(std::int32_t) + 1;  // steps, and sets
  if (results.spec().silence) of_cell += sizeof(std::int32_t);
  if (results.spec().controller.file)
    of_cell += 2 * static_cast<double>(PackedPairs::bytes_for(results.inputs().count()));
  return of_cell * static_cast<double>(results.grid().cells()) + abstraction_bytes(results);
}

FileSets::FileSets(const ResultsReader& results, std::size_t partition, ThreadTeam& team)
    : results_(results), partition_(partition), model_(make_model(results.spec())), context_(model_) {
  // Tubes are not stored.
  const bool is_stored = results.has_abstraction() && !results.spec().abstraction.between_samples;
  context_.abstraction =
      is_stored ? results.abstraction() : build_abstraction(model_.spec(), model_.shapes(), team);
  const UniformGrid& grid = context_.abstraction->grid;
  collision_time_ = results.values(paths::kCollisionTime, all_cells(grid));
  delays_ = read_steps(kDelayKind);
  if (results.spec().silence) silence_ = read_steps(kSilenceKind);
  const std::vector<std::uint8_t> safe = results.members(paths::kSafe, all_cells(grid));
  context_.safe = cells_with(grid, [&](std::int64_t cell) { return safe[at(cell)] != 0; });
  invariant_ = cells_with(grid, [&](std::int64_t cell) { return delays_.steps[at(cell)] >= 0; });
  if (results.spec().controller.file) {
    ListedController& listed = context_.listed.emplace();
    listed.pairs.inputs = results.inputs().count();
    listed.pairs.bytes = results.bits(paths::kListed, all_cells(results.grid()));
  }
  context_.beyond = safe_beyond_limits(results.spec(), *context_.abstraction, context_.safe, team);
}

FileSteps FileSets::read_steps(const CountdownKind& kind) const {
  const StoredPartition stored = read_partition_values(results_.spec(), results_, kind.prefix())[partition_];
  const auto deepest = static_cast<std::int32_t>(stored.layer_sizes.size()) - 1;
  return {.steps = results_.values(kind.layered, partition_, all_cells(results_.grid())),
          .deepest = stored.truncated() ? deepest : kUnbounded};
}

CounterexampleProblem FileSets::problem(const FileSteps& values) const {
  CounterexampleProblem problem{
      .context = &context_,
      .invariant = &invariant_,
      .collision_time =
          [this](std::int64_t cell) {
            const std::int32_t time = collision_time_[at(cell)];
            return time == kUnbounded ? INT64_MAX : time;
          },
      .value = [&values](std::int64_t cell) { return values.steps[at(cell)]; },
      .partition = &results_.spec().coordination.partitions[partition_],
      .inside = [&values](std::int64_t cell) { return values.steps[at(cell)] >= 0; }};
  for (std::size_t i = 0; i < context_.abstraction->grid.size(); ++i)
    problem.number_stride.push_back(context_.abstraction->grid.stride(i));
  return problem;
}

}  // namespace coordreq
