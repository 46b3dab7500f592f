#include "engine/row_hull.hpp"

namespace coordreq {

RowHull::RowHull(const RowEngine& engine) : engine_(&engine), is_bound_(engine.demands().empty()) {
  const RowFamily posts = engine.posts();
  for (std::size_t i = 0; i < engine.tables(); ++i) {
    const bool is_along = i >= engine.across();
    hulls_.push_back(slice_hulls(posts.slices[i], engine.grid()[i],
                                 is_along ? &posts.shape.dimensions[i - engine.across()] : nullptr));
  }
}

const SliceHull& RowHull::hull(const RowPlace& place, std::size_t i) const {
  const RowSlices& slices = engine_->slices()[i];
  return hulls_[i][static_cast<std::size_t>(place.offset(slices.state_stride) / slices.input_combinations)];
}

void RowHull::box(const RowPlace& place, RowBox& box) const {
  box.resize(engine_->grid());
  box.covers = is_bound_;
  for (std::size_t i = 0; i < engine_->tables(); ++i) {
    const SliceHull& own = hull(place, i);
    box[i] = own.range;
    box.covers = box.covers && own.covers;
  }
}

std::vector<std::uint8_t> RowHull::rows_met(const CellSet* set, RowShare::Range rows) const {
  std::vector<std::uint8_t> met(static_cast<std::size_t>(engine_->rows()), 0);
  std::vector<std::int64_t> counter;
  RowBox own;
  RowPlace place(engine_->grid(), rows.begin);
  for (; place.row < rows.end; place.advance(engine_->grid())) {
    if (set != nullptr && !any_set(set->row(place.row))) continue;
    box(place, own);
    for_each_row(engine_->grid(), 0, own.ranges, counter,
                 [&](std::int64_t row) { met[static_cast<std::size_t>(row)] = 1; });
  }
  return met;
}

std::uint64_t RowHull::bytes() const {
  std::uint64_t total = 0;
  for (const std::vector<SliceHull>& hulls : hulls_) total += hulls.size() * sizeof(SliceHull);
  return total;
}

}  // namespace coordreq
