#include "verify/check_tube.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "answers/checking/cell_location.hpp"
#include "answers/checking/cell_pieces.hpp"
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

bool TubeTally::is_unbounded(std::int64_t position) const {
  const IndexRange claimed = claimed_.at(position);
  return claimed.first == INT32_MIN && claimed.last == INT32_MAX;
}

bool TubeTally::is_enough(std::int64_t position, std::int64_t by,
                          const std::vector<TubeBounds>& tubes) const {
  const IndexRange claimed = claimed_.at(position);
  return !tubes.empty() && std::all_of(tubes.begin(), tubes.end(), [&](const TubeBounds& tube) {
    return holds(dimension_, claimed, moved(tube.outer, by));
  });
}

bool TubeTally::is_exact(IndexRange claimed, std::int64_t by, const std::vector<TubeBounds>& tubes) const {
  IndexRange all = moved(tubes.front().outer, by);
  for (const TubeBounds& tube : tubes) {
    const TubeBounds least = TubeBounds::of(tube.inner, tube.inner);
    if (tube.outer != least.outer) return false;
    all = both_of(all, moved(tube.outer, by), dimension_);
  }
  return holds(dimension_, all, claimed);
}

void TubeTally::add(std::int64_t position, std::int64_t by, const std::vector<TubeBounds>& tubes) {
  tally_.add_checked(1);
  const IndexRange claimed = claimed_.at(position);
  if (is_enough(position, by, tubes)) {
    if (exact_ && !is_exact(claimed, by, tubes)) exact_ = false;
    return;
  }
  exact_ = false;
  for (const TubeBounds& tube : tubes) {
    const IndexRange needed = moved(tube.inner, by);
    if (holds(dimension_, claimed, needed)) continue;
    tally_.add_wrong(position, [&] { return text_of(position, TubeBounds::of(needed, needed).outer); });
    return;
  }
  tally_.add_unproven(position, [&] {
    return tubes.empty()
               ? entry_text(*question_.grid, *question_.inputs, claimed_, position) + ": no bound was found"
               : text_of(position, moved(tubes.front().outer, by));
  });
}

std::string TubeTally::text_of(std::int64_t position, IndexRange needed) const {
  const IndexRange claimed = claimed_.at(position);
  return fmt::format("{}: {} {}, expected at least {}",
                     entry_text(*question_.grid, *question_.inputs, claimed_, position), dimension_.name,
                     range_text(dimension_, claimed), range_text(dimension_, needed));
}

TubeFinding TubeTally::finding(bool may_be_exact) {
  const bool exact = may_be_exact && exact_;
  tally_.set_note(exact ? "exact" : "enclosures");
  return {tally_.finding(), exact};
}

}  // namespace coordreq
