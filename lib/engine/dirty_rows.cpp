#include "engine/dirty_rows.hpp"

#include <algorithm>
#include <span>

namespace coordreq {

DirtyRows::DirtyRows(const RowEngine& engine, const RowHull& hull, std::int64_t unit_rows)
    : engine_(engine),
      hull_(hull),
      unit_rows_(unit_rows),
      changed_(static_cast<std::size_t>(engine.rows())),
      unit_changed_(static_cast<std::size_t>((engine.rows() + unit_rows - 1) / unit_rows), 0),
      seen_(unit_changed_.size(), kBeforeAll),
      coarse_dimensions_(engine.outer() / 2),
      coarse_rows_(coarse_dimensions_ == 0 ? 1 : engine.grid().row_stride(coarse_dimensions_ - 1)),
      place_(engine.grid(), 0) {
  for (std::size_t i = 0; i < engine.outer(); ++i)
    unit_strides_.push_back(engine.grid().row_stride(i) / unit_rows_);
  if (coarse_dimensions_ == 0) return;
  for (std::size_t i = 0; i < coarse_dimensions_; ++i)
    coarse_strides_.push_back(engine.grid().row_stride(i) / coarse_rows_);
  coarse_changed_.assign(static_cast<std::size_t>(engine.rows() / coarse_rows_), 0);
}

bool DirtyRows::is_pending(std::int64_t unit) {
  if (is_unseen(unit)) return true;
  const std::uint32_t seen = seen_[static_cast<std::size_t>(unit)];
  if (last_change_ < seen) return false;
  if (engine_.outer() == 0) return true;
  go_to(unit);
  enclose_unit(place_, scratch_);
  const auto any_since = [&](std::size_t dimensions, const std::vector<std::uint32_t>& changed,
                             const std::vector<std::int64_t>& strides) {
    const std::span<const IndexRange> ranges(scratch_.box.ranges.data(), dimensions);
    return any_in_box(
        ranges, [&](std::size_t i) { return std::int64_t{engine_.grid()[i].count}; },
        [&](std::size_t i) { return strides[i]; }, scratch_.counter,
        [&](std::int64_t number) { return changed[static_cast<std::size_t>(number)] >= seen; });
  };
  if (coarse_dimensions_ > 0 && !any_since(coarse_dimensions_, coarse_changed_, coarse_strides_))
    return false;
  return any_since(engine_.outer(), unit_changed_, unit_strides_);
}

void DirtyRows::go_to(std::int64_t unit) {
  const std::int64_t row = unit * unit_rows_;
  const std::int64_t steps = (row - place_.row) / unit_rows_;
  constexpr std::int64_t kFewSteps = 4;
  if (steps > kFewSteps || steps < -kFewSteps) place_ = RowPlace(engine_.grid(), row);
  while (place_.row != row) place_.step(engine_.grid(), engine_.outer(), row < place_.row);
}

/// The box is the same for all rows of the unit in the shared dimensions; in others the first row may have
/// none, as it need not be held.
void DirtyRows::enclose_unit(const RowPlace& place, Scratch& scratch) const {
  scratch.box.ranges.clear();
  for (std::size_t i = 0; i < engine_.outer(); ++i) scratch.box.ranges.push_back(hull_.range(place, i));
}

void DirtyRows::enter(std::int64_t unit, Scratch& scratch) const {
  if (engine_.outer() == 0) return;
  enclose_unit(RowPlace(engine_.grid(), unit * unit_rows_), scratch);
  scratch.merged.assign(static_cast<std::size_t>(unit_rows_), 0);
  for_each_row(engine_.grid(), 0, scratch.box.ranges, scratch.counter, [&](std::int64_t row) {
    const std::uint32_t* changed = changed_.data() + row;
    for (std::size_t i = 0; i < scratch.merged.size(); ++i)
      scratch.merged[i] = std::max(scratch.merged[i], changed[i]);
  });
}

bool DirtyRows::meets_change(const RowPlace& place, std::int64_t unit, Scratch& scratch) const {
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
