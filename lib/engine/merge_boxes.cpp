#include "engine/merge_boxes.hpp"

#include <algorithm>

namespace coordreq {
namespace {

/// a = the union of a and b, if the union is a box. @returns whether it is
bool join(std::span<IndexRange> a, std::span<const IndexRange> b, std::span<const std::int64_t> longest) {
  std::size_t different = a.size();
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    if (different != a.size()) return false;
    different = i;
  }
  if (different == a.size()) return true;
  IndexRange& range = a[different];
  const IndexRange& other = b[different];
  const bool has_gap =
      std::int64_t{range.last} + 1 < other.first || std::int64_t{other.last} + 1 < range.first;
  const IndexRange both{std::min(range.first, other.first), std::max(range.last, other.last)};
  if (has_gap || std::int64_t{both.last} - both.first + 1 > longest[different]) return false;
  range = both;
  return true;
}

}  // namespace

void BoxList::erase(std::size_t i) {
  const auto begin = ranges.begin() + static_cast<std::ptrdiff_t>(i * dimensions);
  ranges.erase(begin, begin + static_cast<std::ptrdiff_t>(dimensions));
}

bool is_inside(std::span<const IndexRange> a, std::span<const IndexRange> b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].first < b[i].first || a[i].last > b[i].last) return false;
  }
  return true;
}

void merge_boxes(BoxList& boxes, std::span<const std::int64_t> longest) {
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t j = i + 1; j < boxes.size();) {
        if (is_inside(boxes[i], boxes[j])) {
          std::copy(boxes[j].begin(), boxes[j].end(), boxes[i].begin());
        } else if (!is_inside(boxes[j], boxes[i]) && !join(boxes[i], boxes[j], longest)) {
          ++j;
          continue;
        }
        boxes.erase(j);
        again = true;
      }
    }
  }
}

}  // namespace coordreq
