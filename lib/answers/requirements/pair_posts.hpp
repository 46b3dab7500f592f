#pragma once

#include <cstdint>
#include <vector>

#include "answers/requirements/region.hpp"
#include "engine/tube_sets.hpp"
#include "reach/abstraction.hpp"

namespace coordreq {

/// f(x, u) one pair at a time, with the reason where it is empty. For the few pairs of a story; whole rows
/// are for PostReader.
class PairPosts {
 public:
  enum class Blocked : std::uint8_t {
    no,
    left_domain,             ///< through an unsafe side, at the sample or on the way there
    unsafe_between_samples,  ///< the tube is not safe
  };
  struct Post {
    Blocked blocked = Blocked::no;
    std::vector<DomainSide> sides;  ///< unsafe ones that were left by, if `left_domain`
    bool all_left = false;          ///< through a safe side: f(x, u) = {T}
    std::vector<IndexRange> box;    ///< else f(x, u), unless blocked; ends as in ResolvedRange::inside
  };

  /// REQUIRES: all outlive this object.
  PairPosts(const Abstraction& abstraction, const TubeSets& tubes)
      : abstraction_(&abstraction), tubes_(tubes) {}

  [[nodiscard]] Post of(std::int64_t x, std::int64_t u) const;

 private:
  void follow_tube(std::int64_t x, std::int64_t u, Post& post) const;

  const Abstraction* abstraction_;
  TubeSets tubes_;
};

/// Calls `visit(cell)` for the cells of a box of ranges, which may wrap in periodic dimensions, until it
/// returns false.
/// @returns false if it was stopped
template <class Visit>
bool for_each_cell(const UniformGrid& grid, const std::vector<IndexRange>& box, const Visit& visit,
                   std::size_t i = 0, std::int64_t cell = 0) {
  if (i == box.size()) return visit(cell);
  for (std::int64_t k = box[i].first; k <= box[i].last; ++k) {
    if (!for_each_cell(grid, box, visit, i + 1, cell + k % grid[i].count * grid.stride(i))) return false;
  }
  return true;
}

}  // namespace coordreq
