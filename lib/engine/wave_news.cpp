#include "engine/wave_news.hpp"

#include <algorithm>
#include <span>

namespace coordreq {

WaveNews::WaveNews(const RowEngine& engine, const RowHull& hull, std::int64_t unit_rows)
    : engine_(engine),
      hull_(hull),
      unit_rows_(unit_rows),
      changed_(static_cast<std::size_t>(engine.rows())),
      unit_changed_(static_cast<std::size_t>((engine.rows() + unit_rows - 1) / unit_rows), 0),
      seen_(unit_changed_.size(), kBeforeAll) {}

bool WaveNews::is_pending(std::int64_t unit) {
  if (is_unseen(unit)) return true;
  const std::uint32_t seen = seen_[static_cast<std::size_t>(unit)];
  if (engine_.outer() == 0) return last_change_ >= seen;
  enclose_unit(unit, scratch_);
  return any_row(engine_.grid(), 0, scratch_.box.ranges, scratch_.counter, [&](std::int64_t row) {
    return unit_changed_[static_cast<std::size_t>(row / unit_rows_)] >= seen;
  });
}

/// It is the same for all rows of the unit. In other dimensions the first one has no box if it is not held.
void WaveNews::enclose_unit(std::int64_t unit, Scratch& scratch) const {
  const RowPlace place(engine_.grid(), unit * unit_rows_);
  scratch.box.ranges.clear();
  for (std::size_t i = 0; i < engine_.outer(); ++i) scratch.box.ranges.push_back(hull_.range(place, i));
}

void WaveNews::enter(std::int64_t unit, Scratch& scratch) const {
  if (engine_.outer() == 0) return;
  enclose_unit(unit, scratch);
  scratch.merged.assign(static_cast<std::size_t>(unit_rows_), 0);
  for_each_row(engine_.grid(), 0, scratch.box.ranges, scratch.counter, [&](std::int64_t row) {
    const std::uint32_t* changed = changed_.data() + row;
    for (std::size_t i = 0; i < scratch.merged.size(); ++i)
      scratch.merged[i] = std::max(scratch.merged[i], changed[i]);
  });
}

bool WaveNews::meets_change(const RowPlace& place, std::int64_t unit, Scratch& scratch) const {
  const std::uint32_t seen = std::max(seen_[static_cast<std::size_t>(unit)], kBeforeAll);
  hull_.box(place, scratch.box);
  const std::size_t outer = engine_.outer();
  const std::span<const IndexRange> inner(scratch.box.ranges.data() + outer,
                                          scratch.box.ranges.size() - outer);
  const std::uint32_t* changed = outer == 0 ? changed_.data() : scratch.merged.data();
  return any_row(engine_.grid(), outer, inner, scratch.counter,
                 [&](std::int64_t row) { return changed[row] >= seen; });
}

}  // namespace coordreq
