#include "safety/row_hull.hpp"

#include <algorithm>

#include "grid/pieces.hpp"
#include "safety/row_window.hpp"

namespace coordreq {
namespace {

using Kind = RowSegment::Kind;
constexpr IndexRange kNone{0, -1};

/// On a ring, with its first index in [0, count).
IndexRange normal(IndexRange range, const GridDimension& target) {
  if (!target.periodic()) return range;
  const auto n = static_cast<std::int32_t>(target.count);
  const std::int32_t first = (range.first % n + n) % n;
  return {first, first + (range.last - range.first)};
}

}  // namespace

RowHull::RowHull(const RowEngine& engine) : engine_(&engine) {
  for (std::size_t t = 0; t < engine.tables(); ++t) {
    const RowSlices& slices = engine.slices()[t];
    std::vector<Entry>& entries = entries_.emplace_back();
    const auto combinations = static_cast<std::size_t>(slices.input_combinations);
    for (std::size_t base = 0; base < slices.ids.size(); base += combinations) {
      entries.push_back(merged(t, base));
    }
  }
}

RowHull::Entry RowHull::merged(std::size_t table, std::size_t base) const {
  const RowSlices& slices = engine_->slices()[table];
  const GridDimension& target = engine_->grid()[table];
  const bool is_last = table + 1 == engine_->tables();
  // A tube can block a post whatever its box is inside of.
  Entry result{kNone, engine_->demands().empty()};
  std::uint32_t previous = UINT32_MAX;
  for (std::int64_t u = 0; u < slices.input_combinations; ++u) {
    const std::uint32_t id = slices.ids[base + static_cast<std::size_t>(u)];
    if (id == previous) continue;
    previous = id;
    const std::vector<RowSegment>& slice = slices.slices[id];
    const Kind expected = is_last ? Kind::shifted : Kind::fixed;
    result.covers = result.covers && slice.size() == 1 && slice[0].kind == expected;
    for (const RowSegment& segment : slice) {
      if (segment.kind != expected) continue;
      const IndexRange range = normal(segment.range, target);
      result.range = result.range == kNone ? range : merge_ranges(result.range, range, target);
    }
  }
  if (result.range == kNone) {
    result.covers = false;
  } else if (is_last) {
    result.range = fit_window(result.range, target.count, engine_->posts().ends);
    // On a ring the arc that holds two windows may begin with the other one, and reach beyond the margins.
    const RowMargins margins = engine_->posts().margins;
    result.covers =
        result.covers && -result.range.first <= margins.before && result.range.last <= margins.after;
  } else if (target.periodic()) {
    result.range = wrap_range(result.range, target.count);
  }
  return result;
}

void RowHull::box(const RowPlace& place, Box& box) const {
  const std::size_t last = engine_->tables() - 1;
  box.ranges.resize(last);
  box.covers = true;
  for (std::size_t t = 0; t <= last; ++t) {
    const RowSlices& slices = engine_->slices()[t];
    const auto choice =
        static_cast<std::size_t>(place.offset(slices.state_stride) / slices.input_combinations);
    const Entry& entry = entries_[t][choice];
    (t == last ? box.window : box.ranges[t]) = entry.range;
    box.covers = box.covers && entry.covers;
  }
}

}  // namespace coordreq
