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

std::uint64_t RowHull::bytes() const {
  std::uint64_t total = 0;
  for (const std::vector<SliceHull>& hulls : hulls_) total += hulls.size() * sizeof(SliceHull);
  return total;
}

}  // namespace coordreq
