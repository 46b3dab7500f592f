#include "export/c_header_tables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "cell/cell_controller.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Gives equal values equal numbers, in the order in which they come.
template <class Value>
class Numbering {
 public:
  std::uint32_t number_of(const Value& value) {
    const auto [at, is_new] = numbers_.try_emplace(value, static_cast<std::uint32_t>(values_.size()));
    if (is_new) values_.push_back(value);
    return at->second;
  }
  [[nodiscard]] std::vector<Value> values() && { return std::move(values_); }

 private:
  std::map<Value, std::uint32_t> numbers_;
  std::vector<Value> values_;
};

}  // namespace

ActionRuns find_action_runs(const ResultsReader& results, std::size_t partition, ThreadTeam& team) {
  CellController controller(results, team);
  controller.prepare_all();
  Numbering<ActionRuns::Entry> entries;
  std::vector<Numbering<std::vector<bool>>> sets(results.partitions()[partition].classes.size());
  ActionRuns runs;
  for (std::int64_t begin = 0; begin < results.grid().cells(); begin += kPartCells) {
    const std::int64_t end = std::min(begin + kPartCells, results.grid().cells());
    const auto countdowns = results.stretch(
        begin, end, [&](const CellBlock& block) { return results.trigger(partition, block); });
    std::vector<std::int32_t> approach;
    if (results.spec().goal) {
      approach = results.stretch(begin, end, [&](const CellBlock& block) {
        return results.values(results.field("/approach_trigger"), partition, block);
      });
    }
    for (std::int64_t cell = begin; cell < end; ++cell) {
      const auto actions = controller.actions(partition, cell);
      ActionRuns::Entry entry{.countdown = countdowns[static_cast<std::size_t>(cell - begin)]};
      for (std::size_t c = 0; c < sets.size(); ++c) entry.sets.push_back(sets[c].number_of(actions[c]));
      if (results.spec().goal) {
        entry.approach_countdown = approach[static_cast<std::size_t>(cell - begin)];
        const auto nearer = controller.approach_actions(partition, cell);
        for (std::size_t c = 0; c < sets.size(); ++c) {
          const bool has_way = std::find(nearer[c].begin(), nearer[c].end(), true) != nearer[c].end();
          entry.approach_sets.push_back(has_way ? sets[c].number_of(nearer[c]) : entry.sets[c]);
        }
      }
      const std::uint32_t number = entries.number_of(entry);
      if (!runs.entry_of.empty() && runs.entry_of.back() == number) continue;
      runs.start.push_back(static_cast<std::uint32_t>(cell));
      runs.entry_of.push_back(number);
    }
  }
  runs.entries = std::move(entries).values();
  for (auto& one : sets) runs.sets.push_back(std::move(one).values());
  return runs;
}

DimensionBounds dimension_bounds(const GridDimension& dimension) {
  DimensionBounds result{.discrete = dimension.discrete, .wraps = dimension.periodic()};
  if (dimension.discrete) {
    for (std::int64_t k = 0; k < dimension.count; ++k)
      result.bounds.push_back(nearest_double(dimension.point(k)));
    return result;
  }
  for (std::int64_t k = 0; k <= dimension.count; ++k) {
    result.bounds.push_back(upper_double(dimension.point(k) - dimension.radius()));
  }
  if (result.wraps) {
    // [lower, upper) begins in the middle of cell 0 and ends where that cell begins again. The double nearest
    // to `lower` may lie below it, on the other side of the seam: that is cell 0 too.
    result.bounds.front() = nearest_double(dimension.lower);
    result.bounds.push_back(upper_double(dimension.upper));
    return result;
  }
  // What is measured beyond a limit by no more than the error reads as the boundary cell: see locate().
  const Rational lowest = dimension.first - dimension.measurement_error;
  const Rational highest = dimension.point(dimension.count - 1) + dimension.measurement_error;
  if (traits(dimension.below).clamps)
    result.bounds.front() = std::min(result.bounds.front(), upper_double(lowest));
  if (traits(dimension.above).clamps) {
    const double beyond = std::nextafter(lower_double(highest), std::numeric_limits<double>::infinity());
    result.bounds.back() = std::max(result.bounds.back(), beyond);
  }
  return result;
}

}  // namespace coordreq
