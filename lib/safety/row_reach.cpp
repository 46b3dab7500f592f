#include "safety/row_reach.hpp"

#include <algorithm>
#include <limits>

namespace coordreq {
namespace {

IndexRange hull(const std::vector<RowSegment>& slice, IndexRange range) {
  for (const RowSegment& segment : slice) {
    if (segment.kind != RowSegment::Kind::fixed) continue;
    range.first = std::min(range.first, segment.range.first);
    range.last = std::max(range.last, segment.range.last);
  }
  return range;
}

}  // namespace

RowReach::RowReach(const RowEngine& engine) : engine_(&engine) {
  for (std::size_t t = 0; t + 1 < engine.tables(); ++t) {
    const RowSlices& slices = engine.slices()[t];
    std::vector<IndexRange>& ranges = ranges_.emplace_back();
    const auto combinations = static_cast<std::size_t>(slices.input_combinations);
    for (std::size_t base = 0; base < slices.ids.size(); base += combinations) {
      IndexRange range{std::numeric_limits<std::int32_t>::max(), -1};
      for (std::size_t u = 0; u < combinations; ++u) range = hull(slices.slices[slices.ids[base + u]], range);
      ranges.push_back(range);
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
  if (range.first > range.last) return false;
  const UniformGrid& grid = engine_->abstraction().grid;
  const std::int64_t step = grid.stride(dimension) / grid.row_length();
  if (dimension + 1 == ranges_.size()) {  // neighbours in this dimension are neighbours in memory
    return changed_in(first_row + range.first, first_row + range.last + 1);
  }
  for (std::int64_t k = range.first; k <= range.last; ++k) {
    if (meets_from(dimension + 1, row, first_row + k * step, changed_before)) return true;
  }
  return false;
}

}  // namespace coordreq
