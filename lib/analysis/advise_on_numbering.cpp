#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "analysis/advice.hpp"
#include "base/index.hpp"
#include "reach/update_ranges.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Upper limits, for each state: posts whose values are all computed, and entries of its table looked at.
constexpr int kMostPosts = 1000;
constexpr std::size_t kMostEntries = 1'000'000;

/// The cell in which an index ends; -1 or the number of cells where that is outside.
std::int64_t cell_of(const GridDimension& dimension, std::int64_t index) {
  if (dimension.periodic()) return (index % dimension.count + dimension.count) % dimension.count;
  const std::int64_t first = dimension.below == Outside::saturate ? 0 : -1;
  const std::int64_t last = dimension.above == Outside::saturate ? dimension.count - 1 : dimension.count;
  return std::clamp(index, first, last);
}

/// A cell that the hull of these values holds and none of them ends in; nothing if there is none, or if the
/// hull is no post since it leaves the domain.
std::optional<std::int64_t> skipped_cell(const GridDimension& dimension,
                                         const std::vector<std::int64_t>& values) {
  std::set<std::int64_t> cells;
  for (const std::int64_t value : values) cells.insert(cell_of(dimension, value));
  const bool is_blocked = (cells.contains(-1) && dimension.below == Outside::unsafe) ||
                          (cells.contains(dimension.count) && dimension.above == Outside::unsafe);
  if (is_blocked) return std::nullopt;
  std::int64_t first = values.front(), last = values.back();
  if (dimension.periodic()) {
    last = std::min(last, first + dimension.count - 1);
  } else {
    first = std::max<std::int64_t>(first, 0);
    last = std::min(last, dimension.count - 1);
  }
  for (std::int64_t k = first; k <= last; ++k) {
    if (!cells.contains(cell_of(dimension, k))) return cell_of(dimension, k);
  }
  return std::nullopt;
}

/// Looks for a post that holds a value which cannot follow.
class SkippedValues {
 public:
  SkippedValues(const ProblemSpec& spec, const Abstraction& abstraction, std::size_t state)
      : spec_(spec),
        abstraction_(abstraction),
        axis_(abstraction.grid.dimension_of(state)),
        ranges_(spec, abstraction.grid, abstraction.inputs, state),
        indices_(spec.slot_count(), 0) {}

  /// @returns "from ... it can become ..., and the successor set holds ... as well"; empty: there is none
  [[nodiscard]] std::string find() {
    const TransitionTable& table = abstraction_.tables[axis_];
    int looked_at = 0;
    const std::size_t entries = std::min(table.entries.size(), kMostEntries);
    for (std::size_t e = 0; e < entries && looked_at < kMostPosts; ++e) {
      if (std::int64_t{table.entries[e].last} - table.entries[e].first < 2) continue;
      ++looked_at;
      go_to(table, table.before + static_cast<std::int64_t>(e));
      const std::vector<std::int64_t> values = ranges_.all_at(indices_);
      if (const auto skipped = skipped_cell(dimension(), values)) return text(table, values, *skipped);
    }
    return "";
  }

 private:
  [[nodiscard]] const GridDimension& dimension() const { return abstraction_.grid[axis_]; }

  void go_to(const TransitionTable& table, std::int64_t position) {
    const UniformGrid& grid = abstraction_.grid;
    for (const std::int32_t i : table.states)
      indices_[spec_.state_slot(grid.state(at(i)))] =
          position / table.state_stride[at(i)] % grid[at(i)].count;
    for (const std::int32_t i : table.inputs)
      indices_[spec_.input_slot(at(i))] =
          position / table.input_stride[at(i)] % abstraction_.inputs[at(i)].count();
  }

  [[nodiscard]] std::string text(const TransitionTable& table, const std::vector<std::int64_t>& values,
                                 std::int64_t skipped) const {
    std::vector<std::string> from, to;
    for (const std::int32_t i : table.states) {
      const GridDimension& one = abstraction_.grid[at(i)];
      from.push_back(one.name + " = " +
                     to_text(one.point(indices_[spec_.state_slot(abstraction_.grid.state(at(i)))])));
    }
    for (const std::int32_t i : table.inputs) {
      const InputSpace::Dimension& input = abstraction_.inputs[at(i)];
      from.push_back(input.name + " = " + to_text(input.values[at(indices_[spec_.input_slot(at(i))])]));
    }
    for (const std::int64_t value : values) {
      std::string text = to_text(dimension().point(value));
      if (std::find(to.begin(), to.end(), text) == to.end()) to.push_back(std::move(text));
    }
    return fmt::format("from {} it can become {}, and the successor set holds {} as well",
                       fmt::join(from, ", "), fmt::join(to, " or "), to_text(dimension().point(skipped)));
  }

  const ProblemSpec& spec_;
  const Abstraction& abstraction_;
  std::size_t axis_;
  UpdateRanges ranges_;
  std::vector<std::int64_t> indices_;
};

}  // namespace

Warnings advise_on_numbering(const AnalysisContext& context) {
  Warnings found;
  for (std::size_t state = 0; state < context.spec.states.size(); ++state) {
    const UpdateSpec* const update = context.spec.dynamics.update(state);
    if (update == nullptr || update->past) continue;
    const std::string example = SkippedValues(context.spec, *context.abstraction, state).find();
    if (example.empty()) continue;
    found.push_back(
        {"numbering", fmt::format("/states/{}", state),
         fmt::format("successor sets are ranges of numbers, so that it matters how the values of {} "
                     "are numbered: {}; give neighbouring numbers to values that can follow "
                     "together",
                     context.spec.states[state].name, example)});
  }
  return found;
}

}  // namespace coordreq
