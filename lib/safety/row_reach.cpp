#include "safety/row_reach.hpp"

#include <algorithm>

#include "grid/pieces.hpp"

namespace coordreq {
namespace {

constexpr IndexRange kNone{0, -1};

IndexRange hull(const std::vector<RowSegment>& slice, IndexRange range, const GridDimension& target) {
  for (const RowSegment& segment : slice) {
    if (segment.kind != RowSegment::Kind::fixed) continue;
    range = range == kNone ? segment.range : merge_ranges(range, segment.range, target);
  }
  return range;
}

}  // namespace

RowReach::RowReach(const RowEngine& engine) : engine_(&engine) {
  for (std::size_t t = 0; t + 1 < engine.tables(); ++t) {
    const RowSlices& slices = engine.slices()[t];
    const GridDimension& target = engine.abstraction().grid[t];
    std::vector<IndexRange>& ranges = ranges_.emplace_back();
    const auto combinations = static_cast<std::size_t>(slices.input_combinations);
    for (std::size_t base = 0; base < slices.ids.size(); base += combinations) {
      IndexRange range = kNone;
      for (std::size_t u = 0; u < combinations; ++u) {
        range = hull(slices.slices[slices.ids[base + u]], range, target);
      }
      ranges.push_back(target.periodic() && range != kNone ? wrap_range(range, target.count) : range);
    }
  }
}

bool RowReach::meets(std::int64_t row, const std::vector<std::int64_t>& changed_before) const {
  return meets_from(0, row, 0, changed_before);
}

bool RowReach::meets_from(std::size_t dimension, std::int64_t row, std::int64_t first_row,
                          const std::vector<std::int64_t>& changed_before) const {
  const auto changed_in = [&](std::int64_t begin, std::int64_t end) {
    return changed_before[static_cast<std::size_t>(end)] != changed_before[static_cast<std::size_t>(begin)];
  };
  if (dimension == ranges_.size()) return changed_in(first_row, first_row + 1);
  const RowSlices& slices = engine_->slices()[dimension];
  const auto choice = static_cast<std::size_t>(engine_->base(row, dimension) / slices.input_combinations);
  const IndexRange range = ranges_[dimension][choice];
  if (range == kNone) return false;
  const UniformGrid& grid = engine_->abstraction().grid;
  const std::int64_t step = grid.stride(dimension) / grid.row_length();
  const std::int64_t count = grid[dimension].count;
  if (dimension + 1 == ranges_.size()) {  // neighbours in this dimension are neighbours in memory
    const std::int64_t end = std::int64_t{range.last} + 1;
    return changed_in(first_row + range.first, first_row + std::min(end, count)) ||
           (end > count && changed_in(first_row, first_row + end - count));
  }
  for (std::int64_t k = range.first; k <= range.last; ++k) {
    const std::int64_t index = k < count ? k : k - count;
    if (meets_from(dimension + 1, row, first_row + index * step, changed_before)) return true;
  }
  return false;
}

}  // namespace coordreq
