#include "engine/row_engine.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <mutex>
#include <set>

#include "base/fast_paths.hpp"

namespace coordreq {
namespace {

using Kind = RowSegment::Kind;

/// With more levels than this in the patches of a unit, for all sizes of boxes, eroding takes longer than it
/// saves.
constexpr double kMostPatchLevels = 1 << 22;
/// Rows that are added up that one thread takes at a time.
constexpr std::int64_t kRowsAtOnce = 1 << 14;

/// Means of a table, from a sample of its entries.
struct TableFigures {
  double choices = 1;  ///< different slices to choose from in a row
  double width = 1;    ///< cells of a range
};

/// Together: several processes add up their samples, and find the same.
TableFigures figures_of(const RowSlices& slices, const RowShare* share) {
  constexpr std::size_t kSamples = 32;
  const auto combinations = static_cast<std::size_t>(slices.input_combinations);
  const std::size_t bases = slices.ids.size() / combinations;
  const std::size_t step = std::max<std::size_t>(1, bases / kSamples);
  std::array<std::int64_t, 4> sums{};
  auto& [samples, choices, ranges, width] = sums;
  for (std::size_t b = 0; b < bases; b += step, ++samples) {
    const auto* begin = slices.ids.data() + b * combinations;
    const std::set<std::uint32_t> distinct(begin, begin + combinations);
    choices += std::ssize(distinct);
    for (const std::uint32_t id : distinct) {
      for (const RowSegment& segment : slices.slices[id]) {
        if (segment.kind == Kind::blocked || segment.kind == Kind::gone) continue;
        width += std::int64_t{1} + segment.range.last - segment.range.first;
        ++ranges;
      }
    }
  }
  if (share != nullptr) share->ranks().add(sums);
  const auto mean = [](std::int64_t sum, std::int64_t count) {
    return static_cast<double>(sum) / static_cast<double>(std::max<std::int64_t>(1, count));
  };
  return {mean(choices, samples), std::max(1.0, mean(width, ranges))};
}

}  // namespace

RowEngine::RowEngine(const Abstraction& abstraction, const PairRules* pairs, const TubeSets& tubes,
                     const RowShare* share, ThreadTeam* team)
    : abstraction_(&abstraction), pairs_(pairs), share_(share) {
  add_family(abstraction.tables, abstraction.grid.dimensions(), team);
  choose_outer();
  if (tubes.inside == nullptr) return;
  std::vector<GridDimension> dimensions =
      (tubes.grid == nullptr ? abstraction.grid : *tubes.grid).dimensions();
  add_demand(tubes.beyond != nullptr ? *tubes.beyond : *tubes.inside, dimensions);
  if (tubes.beyond != nullptr) add_inner_demand(*tubes.inside, std::move(dimensions));
  if (tubes.are_known) take_tube_sets();
}

void RowEngine::add_inner_demand(const CellSet& inside, std::vector<GridDimension> dimensions) {
  // These tubes are blocked where they pass a limit: the others need not be safe beyond it.
  for (GridDimension& dimension : dimensions) {
    if (traits(dimension.below).resets) dimension.below = Outside::unsafe;
    if (traits(dimension.above).resets) dimension.above = Outside::unsafe;
  }
  add_demand(inside, dimensions);
}

void RowEngine::add_demand(const CellSet& inside, const std::vector<GridDimension>& targets) {
  add_family(abstraction_->tubes, targets);
  inside_.push_back(make_levels<std::uint8_t>(family(inside_.size() + 1)));
  inside_sets_.push_back(&inside);
}

void RowEngine::take_tube_sets() {
  ThreadTeam alone(1);
  for (std::size_t k = 0; k < inside_.size(); ++k) put_set(inside_[k], *inside_sets_[k], alone);
}

/// The tables of the inner dimensions as sums, if all of them are sums, and the tables of the dimensions
/// before them move all cells of a unit alike; else none.
std::vector<RowSlices> RowEngine::summed_slices() const {
  const std::vector<TransitionTable>& tables = abstraction_->tables;
  std::size_t outer = 0;
  while (outer < tables.size() && !tables[outer].is_sum()) ++outer;
  if (!fast_paths().added_rows || outer == 0 || !is_closed(outer) || along() != 1) return {};
  std::vector<RowSlices> result;
  double variants = 1;
  for (std::size_t t = outer; t < tables.size(); ++t) {
    std::optional<SumRows> sums = SumRows::make(*abstraction_, tables[t], t);
    if (!sums) return {};
    variants *= 1 + sums->widths().last - sums->widths().first;
    variants *= static_cast<double>(grid()[t].count) + 2 * sums->widths().last + 2;
    result.push_back(keep_as_sums(*abstraction_, tables[t], *std::move(sums)));
  }
  return variants <= kMostPatchLevels ? std::move(result) : std::vector<RowSlices>{};
}

void RowEngine::add_family(const std::vector<TransitionTable>& tables,
                           const std::vector<GridDimension>& targets, ThreadTeam* team) {
  targets_.insert(targets_.end(), targets.begin(), targets.end());
  std::vector<RowSlices> sums;
  if (slices_.empty()) sums = summed_slices();
  const std::size_t cut = tables.size() - sums.size();
  const std::size_t first = slices_.size();
  slices_.resize(first + cut);
  for_each(team, static_cast<std::int64_t>(cut), 1, [&](ThreadTeam::Range range, int) {
    for (auto i = static_cast<std::size_t>(range.begin); i < static_cast<std::size_t>(range.end); ++i)
      slices_[first + i] = cut_into_rows(*abstraction_, tables[i], i, targets[i]);
  });
  for (RowSlices& slices : sums) slices_.push_back(std::move(slices));
  RowShape& shape = shapes_.emplace_back();
  for (std::size_t i = across(); i < tables.size(); ++i) {
    const RowEnds ends{targets[i].below, targets[i].above};
    RowSlices& slices = slices_[slices_.size() - tables.size() + i];
    const std::int64_t count = targets[i].count;
    shape.dimensions.push_back({count, grid().stride(i), margins_of(slices, count, ends, team), ends});
  }
}

/// Brings windows along the row to the shortest of the same meaning. @returns margins that hold them
RowMargins RowEngine::margins_of(RowSlices& slices, std::int64_t count, RowEnds ends,
                                 ThreadTeam* team) const {
  RowMargins margins;
  const auto widen = [](RowMargins& some, IndexRange window) {
    some.before = std::max<std::int64_t>(some.before, -window.first);
    some.after = std::max<std::int64_t>(some.after, window.last);
  };
  for (std::vector<RowSegment>& slice : slices.slices) {
    for (RowSegment& segment : slice) {
      if (segment.kind != Kind::shifted) continue;
      segment.range = fit_window(segment.range, count, ends);
      widen(margins, segment.range);
    }
  }
  if (slices.sums) {
    std::mutex mutex;
    for_each(team, slices.size(), kRowsAtOnce, [&](ThreadTeam::Range range, int) {
      SumRows::Reader reader(*slices.sums);
      RowMargins some;
      for (std::int64_t i = range.begin; i < range.end; ++i) {
        const SumRows::Row row = reader.row(static_cast<std::uint32_t>(i));
        widen(some, fit_window(slices.sums->offset_hull(row), count, ends));
      }
      const std::lock_guard lock(mutex);
      margins.before = std::max(margins.before, some.before);
      margins.after = std::max(margins.after, some.after);
    });
  }
  return margins;
}

RowFamily RowEngine::family(std::size_t number) const {
  return {std::span(slices_).subspan(number * tables(), tables()), shapes_[number]};
}

std::vector<RowEngine::Demand> RowEngine::demands() const {
  std::vector<Demand> result;
  for (std::size_t k = 0; k < inside_.size(); ++k) result.push_back({family(k + 1), &inside_[k]});
  return result;
}

bool RowEngine::is_closed(std::size_t outer) const {
  for (std::size_t t = 0; t < outer; ++t) {
    // Not the strides: they are 0, too, for a state that a table depends on by its shift or a term.
    const std::vector<std::int32_t>& states = abstraction_->tables[t].states;
    if (std::any_of(states.begin(), states.end(),
                    [&](std::int32_t j) { return static_cast<std::size_t>(j) >= outer; })) {
      return false;
    }
  }
  return true;
}

/// Chooses the outer() with which the fewest rows are read for one row: for the shared minima, then of these.
void RowEngine::choose_outer() {
  if (!posts().is_cut()) {
    while (slices_[outer_].is_cut()) ++outer_;
    unit_rows_ = grid().row_stride(outer_ - 1);
    return;
  }
  const std::size_t last = fast_paths().shared_minima ? across() : 0;
  std::vector<TableFigures> figures;
  for (const RowSlices& slices : posts().slices) figures.push_back(figures_of(slices, share_));
  const auto cost = [&](std::size_t outer) {
    double shared = outer == 0 ? 0 : 1;
    double choices = 1;
    double inner = 1;
    for (std::size_t t = 0; t < tables(); ++t) {
      // About two of the choices are tried: others are dominated, or joined with them.
      const double tried = std::min(figures[t].choices, 2.0);
      choices *= tried;
      if (t < outer) {
        shared *= tried * figures[t].width;
      } else {
        inner *= figures[t].width;
      }
    }
    return shared + choices * inner;
  };
  for (std::size_t outer = 1; outer <= last; ++outer) {
    if (is_closed(outer) && cost(outer) < cost(outer_)) outer_ = outer;
  }
  unit_rows_ = outer_ == 0 ? rows() : grid().row_stride(outer_ - 1);
}

}  // namespace coordreq
