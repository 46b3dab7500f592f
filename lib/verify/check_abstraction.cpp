#include "verify/check_abstraction.hpp"

#include <fmt/format.h>

#include "verify/posts.hpp"

namespace coordreq {
namespace {

bool agrees(const GridDimension& dimension, const PostTable& own, IndexRange mine, IndexRange claimed) {
  if (claimed.first > claimed.last || !holds(dimension, claimed, mine)) return false;
  return !own.exact || holds(dimension, mine, claimed);
}

}  // namespace

bool holds(const GridDimension& dimension, IndexRange outer, IndexRange inner) {
  if (!dimension.periodic()) return outer.first <= inner.first && inner.last <= outer.last;
  const IndexRange a = after_leaving(outer, dimension).inside;
  const IndexRange b = after_leaving(inner, dimension).inside;
  if (std::int64_t{a.last} - a.first + 1 >= dimension.count) return true;
  const std::int64_t lead = (b.first - a.first + dimension.count) % dimension.count;
  return lead + (b.last - b.first) <= a.last - a.first;
}

Finding check_abstraction(const GridDimension& dimension, const PostTable& own, const PostTable& claimed,
                          const std::string& what) {
  Tally tally(what + " " + dimension.name);
  tally.set_note(own.exact ? "exact" : "enclosures");
  if (own.states != claimed.states || own.inputs != claimed.inputs) {
    tally.add_wrong(-1, [] { return std::string("depends on other states or inputs than the spec says"); });
    return tally.finding();
  }
  tally.add_checked(static_cast<std::int64_t>(own.entries.size()));
  for (std::size_t e = 0; e < own.entries.size(); ++e) {
    const IndexRange mine = own.entries[e];
    const IndexRange found = claimed.entries[e];
    if (agrees(dimension, own, mine, found)) continue;
    tally.add_wrong(static_cast<std::int64_t>(e), [&] {
      return fmt::format("entry {}: {}..{}, expected {}{}..{}", e, found.first, found.last,
                         own.exact ? "" : "at least ", mine.first, mine.last);
    });
  }
  return tally.finding();
}

}  // namespace coordreq
