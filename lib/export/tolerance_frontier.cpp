#include "export/tolerance_frontier.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "base/index.hpp"
#include "base/requires.hpp"

namespace coordreq {
namespace {

/// Which pairs of values tolerate so much, by rank of each state: 0 is the best value. One state: the second
/// has one value.
class Tolerated {
 public:
  Tolerated(const ResultsReader& results, const ToleranceQuestion& question) : question_(question) {
    for (const ToleranceQuestion::Axis& axis : question.axes)
      counts_.push_back(results.grid()[axis.state].count);
    counts_.resize(2, 1);
    holds_.assign(static_cast<std::size_t>(counts_[0] * counts_[1]), true);
    const CellTable table(results,
                          {.slices = question.given, .projections = {}, .partition = question.partition});
    const RequirementDataset dataset = dataset_of(question.kind, results.spec());
    std::size_t column = 0;
    while (table.columns()[column].field->path != dataset.path) ++column;
    column += dataset.entry;
    table.for_each_row([&](const std::vector<std::int64_t>& index, const std::vector<std::int32_t>& values) {
      if (keeps_limit(values[column])) return;
      const std::int64_t second = question.axes.size() > 1 ? rank(1, index[question.axes[1].state]) : 0;
      holds_[at(rank(0, index[question.axes[0].state]) * counts_[1] + second)] = false;
    });
  }

  /// Runs of indices of the first state. @pre unchecked: there is one state
  [[nodiscard]] std::vector<std::pair<std::int64_t, std::int64_t>> runs() const {
    std::vector<std::pair<std::int64_t, std::int64_t>> all;
    for (std::int64_t k = 0; k < counts_[0]; ++k) {
      if (!holds_[at(rank(0, k))]) continue;
      if (all.empty() || all.back().second != k - 1) all.emplace_back(k, k);
      all.back().second = k;
    }
    return all;
  }

  /// Ranks of the second state below this tolerate it, whatever better rank the first has.
  [[nodiscard]] std::vector<std::int64_t> reach() const {
    std::vector<std::int64_t> all;
    std::int64_t reach = counts_[1];
    for (std::int64_t i = 0; i < counts_[0]; ++i) {
      std::int64_t length = 0;
      while (length < reach && holds_[at(i * counts_[1] + length)]) ++length;
      reach = length;
      all.push_back(reach);
    }
    return all;
  }

  /// The index of a rank, and vice versa.
  [[nodiscard]] std::int64_t rank(std::size_t state, std::int64_t index) const {
    return question_.axes[state].is_large_best ? counts_[state] - 1 - index : index;
  }

 private:
  [[nodiscard]] bool keeps_limit(std::int32_t value) const {
    const RequirementTraits& kind = traits(question_.kind);
    if (kind.is_probability) return probability_of(value) <= question_.risk;
    return kind.is_upper_limit ? 0 <= value && value <= question_.steps : value >= question_.steps;
  }

  const ToleranceQuestion& question_;
  std::vector<std::int64_t> counts_;
  std::vector<bool> holds_;
};

[[maybe_unused]] bool are_all_different(const ToleranceQuestion& question) {
  std::set<std::size_t> states;
  return std::ranges::all_of(question.axes,
                             [&](const auto& axis) { return states.insert(axis.state).second; }) &&
         std::ranges::all_of(question.given,
                             [&](const auto& slice) { return states.insert(slice.dimension).second; });
}

}  // namespace

Tolerance find_tolerance(const ResultsReader& results, const ToleranceQuestion& question) {
  REQUIRES(are_all_different(question) && results.has(dataset_of(question.kind, results.spec()).path));
  const Tolerated tolerated(results, question);
  const std::vector<std::int64_t> reach = tolerated.reach();
  std::vector<FrontierCorner> corners;
  for (std::size_t i = reach.size(); i-- > 0;) {
    const std::int64_t worse = i + 1 < reach.size() ? reach[i + 1] : 0;
    if (reach[i] == worse) continue;
    corners.push_back({tolerated.rank(0, static_cast<std::int64_t>(i))});
    if (question.axes.size() > 1) corners.back().push_back(tolerated.rank(1, reach[i] - 1));
  }
  if (question.axes.size() > 1) return {std::move(corners), {}};
  return {std::move(corners), tolerated.runs()};
}

std::vector<FrontierCorner> tolerance_frontier(const ResultsReader& results,
                                               const ToleranceQuestion& question) {
  return find_tolerance(results, question).corners;
}

}  // namespace coordreq
