#include "engine/row_boxes.hpp"

#include <algorithm>

#include "base/fast_paths.hpp"
#include "base/requires.hpp"

namespace coordreq {

RowBoxes::RowBoxes(const ActionGrouping& grouping)
    : grouping_(grouping), moved_(grouping.size()), kinds_(grouping.size()), ranges_(grouping.size()) {
  const RowEngine& engine = grouping.engine();
  for (std::size_t t = 0; t < engine.tables(); ++t) {
    std::size_t owner = 0;
    std::size_t owners = 0;
    for (std::size_t c = 0; c < grouping.size(); ++c) {
      const std::vector<std::int32_t>& used = grouping.sources()[t].inputs;
      const bool is_owner =
          std::any_of(used.begin(), used.end(), [&](std::int32_t i) { return grouping[c].contains(i); });
      if (!is_owner) continue;
      owner = c;
      ++owners;
    }
    is_product_ = is_product_ && owners <= 1;
    moved_[owner].push_back(t);
  }
  is_product_ =
      is_product_ && fast_paths().product_posts && engine.demands().empty() && engine.posts().is_cut();
  base_.resize(engine.tables());
}

bool RowBoxes::fill(const RowPosition& position, const RowGroups& groups) {
  REQUIRES(is_product());
  for (std::size_t t = 0; t < base_.size(); ++t) base_[t] = grouping_.sources()[t].base(position);
  has_gone_ = false;
  for (std::size_t c = 0; c < moved_.size(); ++c) {
    kinds_[c].clear();
    ranges_[c].clear();
    for (const std::uint32_t action : groups.classes[c]->representative) {
      if (!add(c, action)) return false;
    }
  }
  return true;
}

bool RowBoxes::add(std::size_t c, std::uint32_t action) {
  const RowEngine& engine = grouping_.engine();
  Kind kind = Kind::box;
  for (const std::size_t t : moved_[c]) {
    const std::int64_t position = base_[t] + grouping_.contribution(c, t, action);
    const std::uint32_t id = grouping_.sources()[t].id(position);
    const std::vector<RowSegment>& slice = engine.slices()[t].slices[id];
    const bool is_along = t >= engine.across();
    if (slice.size() != 1 || (is_along && slice[0].kind == RowSegment::Kind::fixed)) return false;
    ranges_[c].push_back(slice[0].range);
    if (slice[0].kind == RowSegment::Kind::blocked) kind = Kind::blocked;
    if (slice[0].kind == RowSegment::Kind::gone && kind != Kind::blocked) kind = Kind::gone;
  }
  kinds_[c].push_back(kind);
  has_gone_ = has_gone_ || kind == Kind::gone;
  return true;
}

void RowBoxes::put(std::size_t c, std::span<const IndexRange> ranges, RowBox& box) const {
  for (std::size_t k = 0; k < moved_[c].size(); ++k) {
    const std::size_t t = moved_[c][k];
    box[t] = ranges[k];
  }
}

void RowBoxes::move(std::size_t c, std::span<const std::int32_t> shift, RowBox& box) const {
  for (const std::size_t t : moved_[c]) {
    if (shift[t] == 0) continue;
    const GridDimension& dimension = grouping_.engine().grid()[t];
    const auto n = static_cast<std::int32_t>(dimension.count);
    const std::int32_t width = box[t].last - box[t].first;
    const std::int32_t first = box[t].first + shift[t];
    box[t].first = dimension.periodic() ? (first % n + n) % n : first;
    box[t].last = box[t].first + width;
  }
}

void RowBoxes::put(std::size_t c, std::span<const Word> ranges, RowBox& box) const {
  for (std::size_t k = 0; k < moved_[c].size(); ++k) {
    const std::size_t t = moved_[c][k];
    box[t] = unpack_range(ranges[k]);
  }
}

}  // namespace coordreq
