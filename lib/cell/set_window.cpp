#include "cell/set_window.hpp"

#include <algorithm>
#include <numeric>

#include "model/odometer.hpp"

namespace coordreq {
namespace {

/// The indices first, ..., first + length - 1.
struct IndexSpan {
  std::int64_t first = 0;
  std::int64_t length = 0;
};

/// The indices that have to be read for a range: all of a periodic dimension where it wraps.
IndexSpan index_span(const IndexRange& range, std::int64_t count) {
  if (range.last >= count) return {0, count};
  return {range.first, range.last - std::int64_t{range.first} + 1};
}

}  // namespace

void SetWindow::cover(std::span<const IndexRange> box) {
  bool covered = !block_.first.empty();
  CellBlock wanted;
  for (std::size_t i = 0; i < grid_.size(); ++i) {
    const IndexSpan span = index_span(box[i], grid_[i].count);
    wanted.first.push_back(span.first);
    wanted.count.push_back(span.length);
    covered = covered && block_.first[i] <= span.first &&
              span.first + span.length <= block_.first[i] + block_.count[i];
  }
  if (covered) return;
  block_ = std::move(wanted);
  add_up();
}

void SetWindow::cover_all() {
  std::vector<IndexRange> all;
  for (const GridDimension& dimension : grid_.dimensions()) {
    all.push_back({0, static_cast<std::int32_t>(dimension.count - 1)});
  }
  cover(all);
}

void SetWindow::add_up() {
  const std::vector<std::uint8_t> members = read_(block_);
  const std::size_t dimensions = block_.count.size();
  stride_.assign(dimensions, 1);
  for (std::size_t i = dimensions - 1; i-- > 0;) stride_[i] = stride_[i + 1] * (block_.count[i + 1] + 1);
  sums_.assign(static_cast<std::size_t>(stride_[0] * (block_.count[0] + 1)), 0);
  Odometer index(block_.count);
  for (const std::uint8_t member : members) {
    std::int64_t position = 0;
    for (std::size_t i = 0; i < dimensions; ++i) position += (index[i] + 1) * stride_[i];
    sums_[static_cast<std::size_t>(position)] = member;
    index.advance();
  }
  for (std::size_t i = 0; i < dimensions; ++i) {
    const auto step = static_cast<std::size_t>(stride_[i]);
    const std::size_t period = step * static_cast<std::size_t>(block_.count[i] + 1);
    for (std::size_t at = 0; at < sums_.size(); ++at) {
      if (at % period >= step) sums_[at] += sums_[at - step];
    }
  }
}

/// Members in the box by inclusion and exclusion, from dimension i on; `corner` is the position so far.
std::int64_t SetWindow::members(std::span<const IndexRange> box, std::size_t i, std::int64_t corner) const {
  if (i == box.size()) return sums_[static_cast<std::size_t>(corner)];
  const std::int64_t count = grid_[i].count;
  const auto between = [&](std::int64_t first, std::int64_t last) {
    return members(box, i + 1, corner + (last + 1 - block_.first[i]) * stride_[i]) -
           members(box, i + 1, corner + (first - block_.first[i]) * stride_[i]);
  };
  if (box[i].last < count) return between(box[i].first, box[i].last);
  return between(box[i].first, count - 1) + between(0, box[i].last - count);
}

bool SetWindow::contains(std::span<const IndexRange> box) const {
  const auto length = [](std::int64_t product, const IndexRange& range) {
    return product * (std::int64_t{range.last} - range.first + 1);
  };
  const std::int64_t cells = std::accumulate(box.begin(), box.end(), std::int64_t{1}, length);
  return members(box, 0, 0) == cells;
}

}  // namespace coordreq
