#include "verify/check_tube.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "answers/checking/cell_parts.hpp"
#include "answers/checking/cell_place.hpp"
#include "base/requires.hpp"
#include "verify/checks.hpp"

namespace coordreq {

IndexRange cells_needed(const GridDimension& dimension, const Rational& lower, const Rational& upper) {
  REQUIRES(lower <= upper);
  const Rational reach = dimension.radius() + dimension.measurement_error;
  const std::int64_t first = floor_to_int((lower - dimension.first + reach) / dimension.step);
  const std::int64_t last = ceil_to_int((upper - dimension.first - reach) / dimension.step);
  return {saturate_index(first), saturate_index(last)};
}

TubeTally::TubeTally(const PostQuestion& question)
    : question_(question),
      dimension_((*question.grid)[question.state]),
      claimed_(*question.claimed),
      tally_("tubes " + dimension_.name) {}

bool TubeTally::is_unbounded(std::int64_t place) const {
  const IndexRange claimed = claimed_.at(place);
  return claimed.first == INT32_MIN && claimed.last == INT32_MAX;
}

bool TubeTally::is_enough(std::int64_t place, std::int64_t by, const std::vector<OwnTube>& tubes) const {
  const IndexRange claimed = claimed_.at(place);
  return !tubes.empty() && std::all_of(tubes.begin(), tubes.end(), [&](const OwnTube& tube) {
    return holds(dimension_, claimed, moved(tube.outer, by));
  });
}

bool TubeTally::is_exact(IndexRange claimed, std::int64_t by, const std::vector<OwnTube>& tubes) const {
  IndexRange all = moved(tubes.front().outer, by);
  for (const OwnTube& tube : tubes) {
    const OwnTube least = OwnTube::of(tube.inner, tube.inner);
    if (tube.outer != least.outer) return false;
    all = both_of(all, moved(tube.outer, by), dimension_);
  }
  return holds(dimension_, all, claimed);
}

void TubeTally::add(std::int64_t place, std::int64_t by, const std::vector<OwnTube>& tubes) {
  tally_.add_checked(1);
  const IndexRange claimed = claimed_.at(place);
  if (is_enough(place, by, tubes)) {
    if (exact_ && !is_exact(claimed, by, tubes)) exact_ = false;
    return;
  }
  exact_ = false;
  for (const OwnTube& tube : tubes) {
    const IndexRange needed = moved(tube.inner, by);
    if (holds(dimension_, claimed, needed)) continue;
    tally_.add_wrong(place, [&] { return text_of(place, OwnTube::of(needed, needed).outer); });
    return;
  }
  tally_.add_unproven(place, [&] {
    return tubes.empty()
               ? entry_text(*question_.grid, *question_.inputs, claimed_, place) + ": no bound was found"
               : text_of(place, moved(tubes.front().outer, by));
  });
}

std::string TubeTally::text_of(std::int64_t place, IndexRange needed) const {
  const IndexRange claimed = claimed_.at(place);
  return fmt::format("{}: {} {}, expected at least {}",
                     entry_text(*question_.grid, *question_.inputs, claimed_, place), dimension_.name,
                     range_text(dimension_, claimed), range_text(dimension_, needed));
}

TubeFinding TubeTally::finding(bool may_be_exact) {
  const bool exact = may_be_exact && exact_;
  tally_.set_note(exact ? "exact" : "enclosures");
  return {tally_.finding(), exact};
}

}  // namespace coordreq
