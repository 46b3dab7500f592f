#include "cell/file_sets.hpp"

#include <algorithm>

#include "answers/invariance/safe_tubes.hpp"
#include "answers/layers/stored_partition.hpp"
#include "answers/paths.hpp"
#include "answers/step_codes.hpp"
#include "base/index.hpp"
#include "base/requires.hpp"
#include "cell/cell_controller.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kPageCells = 65'536;

std::int32_t deepest_of(const ResultsReader& results, const CountdownKind& kind, std::size_t partition) {
  const StoredPartition stored = read_partition_values(results.spec(), results, kind.prefix())[partition];
  return stored.truncated() ? static_cast<std::int32_t>(stored.layer_sizes.size()) - 1 : kUnbounded;
}

}  // namespace

FileSteps::FileSteps(const ResultsReader& results, const char* path, std::optional<std::size_t> partition)
    : results_(results),
      path_(path),
      partition_(partition),
      deepest_(kUnbounded),
      pages_(coordreq::at(results.grid().cells() / kPageCells + 1)) {}

FileSteps::FileSteps(const ResultsReader& results, const CountdownKind& kind, std::size_t partition)
    : FileSteps(results, kind.layered, partition) {
  deepest_ = deepest_of(results, kind, partition);
}

std::int32_t FileSteps::at(std::int64_t cell) const {
  std::vector<std::int32_t>& page = pages_[coordreq::at(cell / kPageCells)];
  if (page.empty()) {
    const std::int64_t begin = cell / kPageCells * kPageCells;
    const std::int64_t end = std::min(begin + kPageCells, results_.grid().cells());
    page = results_.read_run(
        begin, end, [this](const CellBlock& block) { return results_.values(path_, partition_, block); });
  }
  return page[coordreq::at(cell % kPageCells)];
}

bool FileSteps::is_lower_bound(std::int64_t cell) const {
  return deepest_ != kUnbounded && at(cell) == deepest_;
}

bool FileSteps::is_bounded(std::int64_t cell) const {
  return at(cell) != kUnbounded && !is_lower_bound(cell);
}

StepsFrom FileSteps::layers() const {
  return [this](std::int64_t cell) {
    return is_bounded(cell) ? std::max<std::int64_t>(at(cell) + 1, 0) : INT64_MAX;
  };
}

double FileSets::bytes(const ResultsReader& results) {
  const ProblemSpec& spec = results.spec();
  double of_cell = (spec.silence ? 3 : 2) * sizeof(std::int32_t) + 1;  // steps, and sets
  if (spec.abstraction.between_samples) of_cell += 1;                  // S as it is read
  if (spec.controller.file)
    of_cell += 2 * static_cast<double>(PackedPairs::bytes_for(results.inputs().count()));
  return of_cell * static_cast<double>(results.grid().cells()) + abstraction_bytes(results);
}

FileSets::FileSets(const ResultsReader& results, std::size_t partition, ThreadTeam& team)
    : results_(results),
      partition_(partition),
      model_(make_model(results.spec())),
      context_(model_),
      collision_time_(results, paths::kCollisionTime, std::nullopt),
      delays_(results, kDelayKind, partition) {
  const ProblemSpec& spec = results.spec();
  const bool has_tubes = spec.abstraction.between_samples;  // these are not stored
  context_.abstraction = results.has_abstraction() && !has_tubes
                             ? results.abstraction()
                             : build_abstraction(model_.spec(), model_.shapes(), team);
  if (spec.silence) silence_.emplace(results, kSilenceKind, partition);
  const UniformGrid& grid = context_.abstraction->grid;
  if (spec.controller.file) {
    ListedController& listed = context_.listed.emplace();
    listed.pairs.inputs = results.inputs().count();
    listed.pairs.bytes = results.bits(paths::kListed, all_cells(grid));
  }
  context_.safe = CellSet(grid.rows(), grid.row_length());
  if (!has_tubes) return;  // nothing asks for S
  const std::vector<std::uint8_t> safe = results.members(paths::kSafe, all_cells(grid));
  for (std::int64_t cell = 0; cell < grid.cells(); ++cell) {
    if (safe[at(cell)] != 0) context_.safe.set(cell);
  }
  context_.beyond = safe_beyond_limits(spec, *context_.abstraction, context_.safe, team);
}

const FileSteps& FileSets::silence() const {
  REQUIRES(silence_.has_value());
  return *silence_;
}

CounterexampleProblem FileSets::problem(const FileSteps& values) const {
  CounterexampleProblem problem{.context = &context_,
                                .invariant = [this](std::int64_t cell) { return delays_.at(cell) >= 0; },
                                .collision_time =
                                    [this](std::int64_t cell) {
                                      const std::int32_t time = collision_time_.at(cell);
                                      return time == kUnbounded ? INT64_MAX : time;
                                    },
                                .value = [&values](std::int64_t cell) { return values.at(cell); },
                                .partition = &results_.spec().coordination.partitions[partition_],
                                .inside = [&values](std::int64_t cell) { return values.at(cell) >= 0; }};
  const UniformGrid& grid = context_.abstraction->grid;
  for (std::size_t i = 0; i < grid.size(); ++i) problem.number_stride.push_back(grid.stride(i));
  return problem;
}

}  // namespace coordreq
