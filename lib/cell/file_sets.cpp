#include "cell/file_sets.hpp"

#include "answers/countdown/kinds.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "answers/layers/stored_partition.hpp"
#include "answers/paths.hpp"
#include "answers/step_codes.hpp"
#include "base/requires.hpp"
#include "cell/cell_controller.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Levels = LevelRows<std::uint32_t>;

/// A level of steps as the file has them: never lost, lost after so many, or not there from the start.
std::uint32_t level_of_steps(std::int32_t steps, std::int32_t first) {
  if (steps == kUnbounded) return Levels::kTop;
  return steps < 0 ? 0 : static_cast<std::uint32_t>(steps + first);
}

void take_sizes(const StoredPartition& stored, DelayLayers& layers) {
  layers.sizes.assign(stored.layer_sizes.begin(), stored.layer_sizes.end());
  layers.fixed_point_index = stored.fixed_point_index;
  layers.truncated = stored.truncated();
}

}  // namespace

double FileSets::bytes(const ResultsReader& results) {
  constexpr double kBytesOfCell = 2 * sizeof(std::uint32_t) + 1;  // two levels, narrowed after all, and sets
  double of_cell = kBytesOfCell;
  if (results.spec().silence) of_cell += 2 * sizeof(std::uint32_t);
  if (results.spec().controller.file)
    of_cell += 2 * static_cast<double>(PackedPairs::bytes_for(results.inputs().count()));
  return of_cell * static_cast<double>(results.grid().cells()) + abstraction_bytes(results);
}

FileSets::FileSets(const ResultsReader& results, std::size_t partition, ThreadTeam& team)
    : results_(results), model_(make_model(results.spec())), context_(model_) {
  // Tubes are not stored.
  const bool is_stored = results.has_abstraction() && !results.spec().abstraction.between_samples;
  context_.abstraction =
      is_stored ? results.abstraction() : build_abstraction(model_.spec(), model_.shapes(), team);
  read_cells(partition);
  if (results.spec().silence) read_silence(partition);
  if (results.spec().controller.file) read_listed();
  context_.beyond = safe_beyond_limits(results.spec(), *context_.abstraction, context_.safe, team);
}

void FileSets::read_cells(std::size_t partition) {
  const UniformGrid& grid = context_.abstraction->grid;
  const std::int64_t length = grid.row_length();
  context_.safe = CellSet(grid.rows(), length);
  invariance_.invariant = CellSet(grid.rows(), length);
  Levels collision_time(grid.rows(), length, {}, {});
  Levels layers_of(grid.rows(), length, {}, {});
  take_sizes(results_.partitions()[partition], layers_);
  const auto last = static_cast<std::int32_t>(layers_.sizes.size()) - 1;
  for (std::int64_t r = 0; r < grid.rows(); ++r) {
    const auto read = [&](const auto& part) { return results_.stretch(r * length, (r + 1) * length, part); };
    const auto safe = read([&](const CellBlock& block) { return results_.members(paths::kSafe, block); });
    const auto times =
        read([&](const CellBlock& block) { return results_.values(paths::kCollisionTime, block); });
    const auto delays =
        read([&](const CellBlock& block) { return results_.values(paths::kDelay, partition, block); });
    std::vector<std::uint32_t> times_of_row, layers_of_row;
    for (std::int64_t i = 0; i < length; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (safe[at] != 0) context_.safe.set(r * length + i);
      if (delays[at] >= 0) invariance_.invariant.set(r * length + i);
      times_of_row.push_back(level_of_steps(times[at], 0));
      const bool is_cut_off = layers_.truncated && delays[at] == last;
      layers_of_row.push_back(is_cut_off ? Levels::kTop : level_of_steps(delays[at], 1));
    }
    collision_time.put(r, times_of_row.data());
    layers_of.put(r, layers_of_row.data());
  }
  invariance_.collision_time = LevelMap(std::move(collision_time));
  layers_.layers_of = LevelMap(std::move(layers_of));
}

void FileSets::read_silence(std::size_t partition) {
  const UniformGrid& grid = context_.abstraction->grid;
  const std::int64_t length = grid.row_length();
  take_sizes(read_partition_values(results_.spec(), results_, kSilenceKind.prefix())[partition], silence_);
  const auto last = static_cast<std::int32_t>(silence_.sizes.size()) - 1;
  Levels silence(grid.rows(), length, {}, {}), lost(grid.rows(), length, {}, {});
  for (std::int64_t r = 0; r < grid.rows(); ++r) {
    const auto steps = results_.stretch(r * length, (r + 1) * length, [&](const CellBlock& block) {
      return results_.values(paths::kSilence, partition, block);
    });
    std::vector<std::uint32_t> silence_of_row, lost_of_row;
    for (std::int64_t i = 0; i < length; ++i) {
      const std::int32_t own = steps[static_cast<std::size_t>(i)];
      const bool is_cut_off = silence_.truncated && own == last;
      silence_of_row.push_back(is_cut_off ? Levels::kTop : level_of_steps(own, 1));
      lost_of_row.push_back(own >= 0 ? Levels::kTop : own == kOutsideSafe ? 0 : 1);
    }
    silence.put(r, silence_of_row.data());
    lost.put(r, lost_of_row.data());
  }
  silence_.layers_of = LevelMap(std::move(silence));
  lost_ = LevelMap(std::move(lost));
}

void FileSets::read_listed() {
  ListedController listed;
  listed.pairs.inputs = results_.inputs().count();
  listed.pairs.bytes = results_.bits(paths::kListed, all_cells(results_.grid()));
  context_.listed = std::move(listed);
}

const DelayLayers& FileSets::silence() const {
  REQUIRES(results_.spec().silence);
  return silence_;
}

std::vector<std::int64_t> FileSets::number_stride() const {
  std::vector<std::int64_t> strides;
  for (std::size_t i = 0; i < context_.abstraction->grid.size(); ++i)
    strides.push_back(context_.abstraction->grid.stride(i));
  return strides;
}

}  // namespace coordreq
