#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/outside.hpp"

namespace coordreq {

/// Boxes of cells of some dimensions, one after the other: `dimensions` ranges each.
struct BoxList {
  std::size_t dimensions = 1;
  std::vector<IndexRange> ranges;

  [[nodiscard]] std::size_t size() const { return dimensions == 0 ? 0 : ranges.size() / dimensions; }
  [[nodiscard]] std::span<IndexRange> operator[](std::size_t i) {
    return {ranges.data() + i * dimensions, dimensions};
  }
  [[nodiscard]] std::span<const IndexRange> operator[](std::size_t i) const {
    return {ranges.data() + i * dimensions, dimensions};
  }
  void erase(std::size_t i);
};

/// True if `a` lies in `b` in every dimension.
[[nodiscard]] bool is_inside(std::span<const IndexRange> a, std::span<const IndexRange> b);

/// Replaces boxes by fewer with the same union: removes boxes inside another, and joins two that differ in
/// one dimension only and leave no gap there. Not the fewest possible.
/// @param longest [dimension] no range gets longer than this (on a ring a range must not overlap itself)
void merge_boxes(BoxList& boxes, std::span<const std::int64_t> longest);

}  // namespace coordreq
