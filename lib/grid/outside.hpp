#pragma once

#include <compare>
#include <cstdint>

#include "spec/problem_spec.hpp"

namespace coordreq {

/// Grid indices first, ..., last of the cells that a post meets in one dimension, on the lattice that goes on
/// beyond the domain, so that they may be negative or too large ("raw"). Saturated to 32 bits.
struct IndexRange {
  std::int32_t first = 0;
  std::int32_t last = 0;
  [[nodiscard]] auto operator<=>(const IndexRange&) const = default;
};

/// Narrows to 32 bits, saturating: an index that far out has left the domain all the same.
[[nodiscard]] std::int32_t saturate_index(std::int64_t index);

/// A raw range after the rules of both sides.
struct ResolvedRange {
  bool blocked = false;  ///< left through an unsafe side: the pair has no post
  IndexRange inside;  ///< cells of the domain that must be in the target; first > last if all has left safely

  [[nodiscard]] bool all_left() const { return inside.first > inside.last; }
};

/// Contract, "Leaving the domain": `unsafe` blocks, `safe` drops what left, `saturate` moves it to the
/// boundary cell. REQUIRES raw.first <= raw.last, count >= 1, and sides that are unsafe, safe or saturate.
[[nodiscard]] ResolvedRange resolve(IndexRange raw, std::int64_t count, Outside below, Outside above);

}  // namespace coordreq
