#include "results/compare_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/error.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

std::string points_text(std::int64_t count) {
  return fmt::format("{} point{}", count, count == 1 ? "" : "s");
}

std::string unit_text(const std::string& unit) {
  return unit.empty() ? "none" : fmt::format("'{}'", unit);
}

/// The names that mean different things in the two files.
class Difference {
 public:
  Difference(const ResultsReader& before, const ResultsReader& after) : before_(before), after_(after) {}

  /// @throws ResultsError unless the texts are the same
  void check(const std::string& subject, const std::string& old, const std::string& now) const {
    if (old == now) return;
    throw ResultsError(fmt::format("expected {} as in {}: {}, found {}", subject, before_.path(), old, now),
                       after_.path());
  }

 private:
  const ResultsReader& before_;
  const ResultsReader& after_;
};

void check_state(const Difference& difference, const StateSpec& old, const StateSpec& now) {
  const auto of_state = [&old](const char* what) { return fmt::format("{} of {}", what, old.name); };
  difference.check(of_state("the grid"), points_text(old.grid.count), points_text(now.grid.count));
  difference.check(of_state("the first grid point"), to_text(old.grid.first), to_text(now.grid.first));
  if (old.grid.count > 1)
    difference.check(of_state("the step"), to_text(old.grid.step), to_text(now.grid.step));
  difference.check(of_state("the unit"), unit_text(old.unit), unit_text(now.unit));
  const auto kind = [](const StateSpec& state) { return state.discrete ? "discrete" : "continuous"; };
  difference.check(of_state("the kind"), kind(old), kind(now));
}

bool same_classes(const PartitionSpec& a, const PartitionSpec& b) {
  return a.canonical == b.canonical;
}

bool same_name(const PartitionSpec& a, const PartitionSpec& b) {
  return a.name == b.name;
}

}  // namespace

void check_comparable(const ResultsReader& before, const ResultsReader& after) {
  const Difference difference(before, after);
  const ProblemSpec& old = before.spec();
  const ProblemSpec& now = after.spec();
  for (std::size_t i = 0; i < std::max(old.states.size(), now.states.size()); ++i) {
    const auto name = [i](const ProblemSpec& spec) {
      return i < spec.states.size() ? fmt::format("'{}'", spec.states[i].name) : "none";
    };
    difference.check(fmt::format("state {}", i + 1), name(old), name(now));
  }
  for (std::size_t i = 0; i < old.states.size(); ++i) check_state(difference, old.states[i], now.states[i]);
  const auto period = [](const ProblemSpec& spec) {
    const std::string& unit = spec.dynamics.unit;
    return to_text(spec.dynamics.period) + (unit.empty() ? "" : " ") + unit;
  };
  difference.check("the period", period(old), period(now));
}

void match_partitions(const ProblemSpec& before, const ProblemSpec& after, ResultsComparison& result) {
  const std::vector<PartitionSpec>& old = before.coordination.partitions;
  const std::vector<PartitionSpec>& now = after.coordination.partitions;
  std::vector<std::optional<std::size_t>> partner(old.size());
  std::vector<bool> matched(now.size(), false);
  for (const auto same : {same_name, same_classes}) {
    for (std::size_t i = 0; i < old.size(); ++i) {
      for (std::size_t j = 0; j < now.size() && !partner[i]; ++j) {
        if (matched[j] || !same(old[i], now[j])) continue;
        partner[i] = j;
        matched[j] = true;
      }
    }
  }
  for (std::size_t i = 0; i < old.size(); ++i) {
    if (partner[i]) {
      result.partitions.push_back({.before = i, .after = *partner[i]});
    } else {
      result.only_before.push_back(i);
    }
  }
  for (std::size_t j = 0; j < now.size(); ++j) {
    if (!matched[j]) result.only_after.push_back(j);
  }
}

}  // namespace coordreq
