#include "export/tolerance_frontier.hpp"

#include <algorithm>
#include <set>

#include "base/index.hpp"
#include "base/requires.hpp"

namespace coordreq {
namespace {

TableSelection selection_of(const ResultsReader& results, const ToleranceQuestion& question) {
  TableSelection selection{.slices = question.given, .projections = {}, .partition = question.partition};
  for (std::size_t i = 0; i < results.grid().size(); ++i) {
    const auto is_over = [i](const ToleranceQuestion::Over& over) { return over.state == i; };
    const auto is_given = [i](const TableSelection::Slice& slice) { return slice.dimension == i; };
    if (std::none_of(question.over.begin(), question.over.end(), is_over) &&
        std::none_of(question.given.begin(), question.given.end(), is_given))
      selection.projections.push_back({i, false});
  }
  return selection;
}

/// Which pairs of values tolerate so much, by rank of each state: 0 is the best value. One state: the second
/// has one value.
class Tolerated {
 public:
  Tolerated(const ResultsReader& results, const ToleranceQuestion& question) : question_(question) {
    for (const ToleranceQuestion::Over& over : question.over)
      counts_.push_back(results.grid()[over.state].count);
    counts_.resize(2, 1);
    holds_.assign(static_cast<std::size_t>(counts_[0] * counts_[1]), false);
    const CellTable table(results, selection_of(results, question));
    std::size_t column = 0;
    while (table.columns()[column].field->path != "/delay") ++column;
    std::vector<std::size_t> places;  // of the states asked about, in a row
    for (const ToleranceQuestion::Over& over : question.over) {
      const auto& kept = table.dimensions();
      places.push_back(
          static_cast<std::size_t>(std::find(kept.begin(), kept.end(), over.state) - kept.begin()));
    }
    table.for_each_row([&](const std::vector<std::int64_t>& index, const std::vector<std::int32_t>& values) {
      const std::int64_t second = places.size() > 1 ? rank(1, index[places[1]]) : 0;
      holds_[at(rank(0, index[places[0]]) * counts_[1] + second)] = values[column] >= question.steps;
    });
  }

  /// Ranks of the second state below this tolerate it, whatever better rank the first has.
  [[nodiscard]] std::vector<std::int64_t> reach() const {
    std::vector<std::int64_t> all;
    std::int64_t reach = counts_[1];
    for (std::int64_t i = 0; i < counts_[0]; ++i) {
      std::int64_t own = 0;
      while (own < reach && holds_[at(i * counts_[1] + own)]) ++own;
      reach = own;
      all.push_back(reach);
    }
    return all;
  }

  /// The index of a rank, and the other way round.
  [[nodiscard]] std::int64_t rank(std::size_t state, std::int64_t index) const {
    return question_.over[state].is_large_best ? counts_[state] - 1 - index : index;
  }

 private:
  const ToleranceQuestion& question_;
  std::vector<std::int64_t> counts_;
  std::vector<bool> holds_;
};

[[maybe_unused]] bool are_all_different(const ToleranceQuestion& question) {
  std::set<std::size_t> states;
  return std::ranges::all_of(question.over,
                             [&](const auto& own) { return states.insert(own.state).second; }) &&
         std::ranges::all_of(question.given,
                             [&](const auto& own) { return states.insert(own.dimension).second; });
}

}  // namespace

std::vector<FrontierCorner> tolerance_frontier(const ResultsReader& results,
                                               const ToleranceQuestion& question) {
  REQUIRES(are_all_different(question));
  const Tolerated tolerated(results, question);
  const std::vector<std::int64_t> reach = tolerated.reach();
  std::vector<FrontierCorner> corners;
  for (std::size_t i = reach.size(); i-- > 0;) {
    const std::int64_t worse = i + 1 < reach.size() ? reach[i + 1] : 0;
    if (reach[i] == worse) continue;
    corners.push_back({tolerated.rank(0, static_cast<std::int64_t>(i))});
    if (question.over.size() > 1) corners.back().push_back(tolerated.rank(1, reach[i] - 1));
  }
  return corners;
}

}  // namespace coordreq
