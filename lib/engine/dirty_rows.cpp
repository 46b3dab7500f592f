#include "engine/dirty_rows.hpp"

#include <algorithm>
#include <span>

namespace coordreq {

DirtyRows::DirtyRows(const RowEngine& engine, const RowHull& hull, const RowUnits& units)
    : engine_(engine),
      hull_(hull),
      units_(units),
      changed_(static_cast<std::size_t>(engine.rows())),
      unit_changed_(static_cast<std::size_t>(units.count()), 0),
      seen_(unit_changed_.size(), kBeforeAll),
      coarse_dimensions_(units.dimensions() / 2),
      coarse_rows_(coarse_dimensions_ == 0 ? 1 : engine.grid().row_stride(coarse_dimensions_ - 1)) {
  if (coarse_dimensions_ == 0) return;
  for (std::size_t i = 0; i < coarse_dimensions_; ++i)
    coarse_strides_.push_back(engine.grid().row_stride(i) / coarse_rows_);
  coarse_changed_.assign(static_cast<std::size_t>(engine.rows() / coarse_rows_), 0);
}

bool DirtyRows::is_pending(std::int64_t unit, Scratch& scratch) const {
  if (is_unseen(unit)) return true;
  const std::uint32_t seen = seen_[static_cast<std::size_t>(unit)];
  if (last_change_ < seen) return false;
  units_.go_to(unit, scratch.position);
  units_.enclose(hull_, scratch.position, scratch.box.ranges);
  const auto is_new = [&](const std::vector<std::uint32_t>& changed) {
    return
        [&changed, seen](std::int64_t number) { return changed[static_cast<std::size_t>(number)] >= seen; };
  };
  if (coarse_dimensions_ > 0) {
    const std::span<const IndexRange> ranges(scratch.box.ranges.data(), coarse_dimensions_);
    const bool is_near_change = any_in_box(
        ranges, [&](std::size_t i) { return std::int64_t{engine_.grid()[i].count}; },
        [&](std::size_t i) { return coarse_strides_[i]; }, scratch.counter, is_new(coarse_changed_));
    if (!is_near_change) return false;
  }
  return units_.any_in(scratch.box.ranges, scratch.counter, is_new(unit_changed_));
}

void DirtyRows::enter(std::int64_t unit, Scratch& scratch) const {
  units_.go_to(unit, scratch.position);
  units_.enclose(hull_, scratch.position, scratch.box.ranges);
  scratch.merged.assign(static_cast<std::size_t>(units_.rows()), 0);
  for_each_row(engine_.grid(), 0, scratch.box.ranges, scratch.counter, [&](std::int64_t row) {
    const std::uint32_t* changed = changed_.data() + row;
    for (std::size_t i = 0; i < scratch.merged.size(); ++i)
      scratch.merged[i] = std::max(scratch.merged[i], changed[i]);
  });
}

bool DirtyRows::meets_change(const RowPosition& position, std::int64_t unit, Scratch& scratch) const {
  const std::uint32_t seen = std::max(seen_[static_cast<std::size_t>(unit)], kBeforeAll);
  hull_.box(position, scratch.box);
  const std::size_t outer = units_.dimensions();
  const std::span<const IndexRange> inner(scratch.box.ranges.data() + outer,
                                          scratch.box.ranges.size() - outer);
  return any_row(engine_.grid(), outer, inner, scratch.counter,
                 [&](std::int64_t row) { return scratch.merged[static_cast<std::size_t>(row)] >= seen; });
}

}  // namespace coordreq
