#include "export/c_header_tables.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>

#include "answers/paths.hpp"
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

class RunFinder {
 public:
  RunFinder(const ResultsReader& results, std::size_t partition, ThreadTeam& team)
      : results_(results),
        partition_(partition),
        controller_(results, team),
        sets_(results.partitions()[partition].classes.size()) {
    controller_.prepare_all();
    for (const AnswerPolicy& policy : controller_.policies()) {
      const bool is_told = policy.name.empty() || !policy.header.where.empty();
      if (is_told && !policy.countdown().empty()) runs_.policies.push_back(policy);
    }
  }

  ActionRuns run() {
    for (std::int64_t begin = 0; begin < results_.grid().cells(); begin += kPartCells)
      add_part(begin, std::min(begin + kPartCells, results_.grid().cells()));
    runs_.entries = std::move(entries_).values();
    for (auto& one : sets_) runs_.sets.push_back(std::move(one).values());
    return std::move(runs_);
  }

 private:
  using Steps = std::vector<std::vector<std::int32_t>>;  ///< [policy][cell of the part]

  template <class Path>
  [[nodiscard]] Steps read(const Path& path, std::int64_t begin, std::int64_t end) const {
    Steps steps;
    for (const AnswerPolicy& policy : runs_.policies) {
      steps.push_back(results_.stretch(begin, end, [&](const CellBlock& block) {
        return results_.values(std::invoke(path, policy), partition_, block);
      }));
    }
    return steps;
  }

  void add_part(std::int64_t begin, std::int64_t end) {
    const Steps delays = read(&AnswerPolicy::delay, begin, end),
                triggers = read(&AnswerPolicy::countdown, begin, end);
    std::vector<std::int32_t> arrivals;
    if (results_.spec().ends_at_goal())
      arrivals = results_.stretch(
          begin, end, [this](const CellBlock& block) { return results_.values(paths::kArrival, block); });
    for (std::int64_t cell = begin; cell < end; ++cell) {
      const auto place = static_cast<std::size_t>(cell - begin);
      ActionRuns::Entry entry;
      entry.is_terminal = !arrivals.empty() && arrivals[place] == 0;
      for (std::size_t k = 0; k < runs_.policies.size(); ++k) {
        entry.countdowns.push_back(triggers[k][place]);
        add_sets(controller_.actions(runs_.policies[k], partition_, cell, delays[k][place]),
                 runs_.policies[k].is_anywhere, entry);
      }
      const std::uint32_t number = entries_.number_of(entry);
      if (!runs_.entry_of.empty() && runs_.entry_of.back() == number) continue;
      runs_.start.push_back(static_cast<std::uint32_t>(cell));
      runs_.entry_of.push_back(number);
    }
  }

  /// @param is_anywhere what is not there is not what another policy says
  void add_sets(const ActionSets& actions, bool is_anywhere, ActionRuns::Entry& entry) {
    std::vector<std::uint32_t> numbers;
    for (std::size_t c = 0; c < sets_.size(); ++c) {
      const bool has_any = std::find(actions[c].begin(), actions[c].end(), true) != actions[c].end();
      const bool is_first = entry.sets.empty() || is_anywhere;
      numbers.push_back(has_any || is_first ? sets_[c].number_of(actions[c]) : entry.sets.front()[c]);
    }
    entry.sets.push_back(std::move(numbers));
  }

  const ResultsReader& results_;
  std::size_t partition_;
  CellController controller_;
  Numbering<ActionRuns::Entry> entries_;
  std::vector<Numbering<std::vector<bool>>> sets_;
  ActionRuns runs_;
};

}  // namespace

ActionRuns find_action_runs(const ResultsReader& results, std::size_t partition, ThreadTeam& team) {
  return RunFinder(results, partition, team).run();
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
  // A value measured beyond a limit by no more than the error reads as the boundary cell: see locate().
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
