#include "verify/checks.hpp"

#include <fmt/format.h>

#include "answers/checking/cell_location.hpp"
#include "answers/checking/posts.hpp"

namespace coordreq {
bool holds(const GridDimension& dimension, IndexRange outer, IndexRange inner) {
  if (!dimension.periodic()) return outer.first <= inner.first && inner.last <= outer.last;
  const IndexRange a = after_leaving(outer, dimension).inside;
  const IndexRange b = after_leaving(inner, dimension).inside;
  if (std::int64_t{a.last} - a.first + 1 >= dimension.count) return true;
  const std::int64_t lead = (b.first - a.first + dimension.count) % dimension.count;
  return lead + (b.last - b.first) <= a.last - a.first;
}

namespace {

/// An end that is cut to 32 bits before it is moved to the cell, or after: less than the dimension apart.
IndexRange without_far_ends(const GridDimension& dimension, IndexRange range) {
  const auto one = [&](std::int32_t index) {
    if (std::int64_t{index} < INT32_MIN + dimension.count) return INT32_MIN;
    return std::int64_t{index} > INT32_MAX - dimension.count ? INT32_MAX : index;
  };
  return dimension.periodic() ? range : IndexRange{one(range.first), one(range.last)};
}

}  // namespace

Finding check_abstraction(const UniformGrid& grid, const InputSpace& inputs, std::size_t state,
                          const PostTable& posts, const PostTable& claimed, const std::string& what) {
  const GridDimension& dimension = grid[state];
  Tally tally(what + " " + dimension.name);
  tally.set_note("exact");
  if (posts.states != claimed.states || posts.inputs != claimed.inputs) {
    tally.add_wrong(-1, [] { return std::string("depends on other states or inputs than the spec says"); });
    return tally.finding();
  }
  for (std::size_t e = 0; e < posts.entries.size(); ++e) {
    tally.add_checked(1);
    const IndexRange mine = without_far_ends(dimension, posts.entries[e]);
    const std::int64_t position = posts.position_of(e);
    const IndexRange range = without_far_ends(dimension, claimed.at(position));
    if (range.first <= range.last && holds(dimension, range, mine) && holds(dimension, mine, range)) continue;
    tally.add_wrong(position, [&] {
      return fmt::format("{}: {} {}, expected {}", entry_text(grid, inputs, posts, position), dimension.name,
                         range_text(dimension, range), range_text(dimension, mine));
    });
  }
  return tally.finding();
}

}  // namespace coordreq
