#include "coordination/pair_projection.hpp"

#include <algorithm>

#include "safety/row_box.hpp"

namespace coordreq {
namespace {

constexpr auto kBits = static_cast<std::size_t>(CellSet::kWordBits);

/// 64 bits of `row` from bit `first` on.
Word word_from(const Word* row, std::size_t first) {
  const std::size_t shift = first % kBits;
  const Word* const word = row + first / kBits;
  return shift == 0 ? word[0] : word[0] >> shift | word[1] << (kBits - shift);
}

}  // namespace

PairProjection::PairProjection(const Controller& controller, const RowBoxes& boxes, std::size_t classes)
    : controller_(controller), boxes_(boxes), engine_(*controller.engine) {
  if (classes != 2 || !boxes.is_product() || boxes.moved(0).empty() || boxes.moved(1).empty()) return;
  leader_ = boxes.moved(0).front() == 0 ? 0 : 1;
  follower_ = 1 - leader_;
  leading_ = boxes.moved(leader_).size();
  // Dimensions ascend: the leader has the first ones if its last one comes before all of the follower's.
  applies_ = boxes.moved(leader_).back() < boxes.moved(follower_).front() && engine_.is_closed(leading_);
  if (!applies_) return;
  unit_rows_ = engine_.row_stride(leading_ - 1);
  words_ = engine_.row_words();
  margins_ = engine_.posts().margins;
  ends_ = engine_.posts().ends;
  // Room for the whole last word, wherever a window begins, and the one after it.
  plane_words_ = static_cast<std::size_t>(margins_.before + margins_.after) / kBits + words_ + 2;
  found_.resize(words_);
}

void PairProjection::find_masks(const RowPlace& place, const RowGroups& groups,
                                std::vector<std::vector<Word>>& masks) {
  const ConstRow invariant = controller_.invariant->row(place.row);
  enter_unit(place, *groups.classes[leader_]);
  row_boxes_.clear();
  row_lists_.clear();
  list(groups, leader_, invariant, leaders_);
  list(groups, follower_, invariant, followers_);
  for (Candidate& candidate : followers_) place_follower(candidate);
  for (std::size_t c = 0; c < 2; ++c) masks[c].assign(groups.classes[c]->size() * words_, 0);
  for (Candidate& leader : leaders_) {
    is_taken_.assign(row_boxes_.size(), 0);
    for (Candidate& follower : followers_) {
      // Each tries the smallest boxes of the other.
      const bool for_leader = follower.is_minimal && !leader.is_full;
      const bool for_follower = leader.is_minimal && !follower.is_full;
      if (!for_leader && !for_follower) continue;
      erode(plane(leader.group), follower, invariant);
      if (for_leader) add(leader, masks[leader_]);
      if (for_follower) add(follower, masks[follower_]);
    }
  }
}

void PairProjection::enter_unit(const RowPlace& place, const ActionGroups& own) {
  const std::int64_t unit = place.row / unit_rows_;
  if (unit == unit_) return;
  unit_ = unit;
  planes_.resize(own.size());
  for (Plane& plane : planes_) plane.is_known = false;
}

/// REQUIRES: the group's post is a box.
const PairProjection::Plane& PairProjection::plane(std::uint32_t group) {
  Plane& plane = planes_[group];
  if (plane.is_known) return plane;
  plane.is_known = true;
  plane.rows.assign(static_cast<std::size_t>(unit_rows_) * plane_words_, 0);
  std::vector<Word> row(words_);
  for (std::int64_t inner = 0; inner < unit_rows_; ++inner) {
    row.assign(words_, ~Word{0});
    for_each_row(engine_, 0, boxes_.ranges(leader_, group), counter_, [&](std::int64_t first) {
      const ConstRow invariant = controller_.invariant->row(first + inner);
      for (std::size_t w = 0; w < words_; ++w) row[w] &= invariant[w];
    });
    continue_row(row, plane.rows.data() + static_cast<std::size_t>(inner) * plane_words_);
  }
  return plane;
}

/// The row at margins().before, and beyond its ends what a post meets there.
void PairProjection::continue_row(const std::vector<Word>& row, Word* out) const {
  const auto before = static_cast<std::size_t>(margins_.before);
  const auto n = static_cast<std::size_t>(engine_.row_length());
  for (std::size_t w = 0; w < words_; ++w) {
    const std::size_t word = w + before / kBits;
    const std::size_t shift = before % kBits;
    out[word] |= row[w] << shift;
    if (shift != 0) out[word + 1] |= row[w] >> (kBits - shift);
  }
  const auto bit = [&row](std::size_t c) { return (row[c / kBits] >> (c % kBits) & 1) != 0; };
  const auto put = [out](std::size_t at, bool value) {
    out[at / kBits] |= Word{value ? 1U : 0U} << (at % kBits);
  };
  const auto beyond = [&](Outside rule, std::size_t boundary) {
    return rule == Outside::safe || (rule != Outside::unsafe && bit(boundary));
  };
  const bool is_ring = ends_.below == Outside::periodic;
  for (std::size_t k = 0; k < before; ++k)
    put(before - 1 - k, is_ring ? bit((n - 1) - k % n) : beyond(ends_.below, 0));
  for (std::size_t k = 0; k < static_cast<std::size_t>(margins_.after); ++k)
    put(before + n + k, is_ring ? bit(k % n) : beyond(ends_.above, n - 1));
}

/// The groups of a class that may be found at all, and where.
void PairProjection::list(const RowGroups& groups, std::size_t c, ConstRow invariant,
                          std::vector<Candidate>& candidates) const {
  const ActionGroups& own = *groups.classes[c];
  candidates.resize(own.size());
  std::size_t count = 0;
  for (std::uint32_t g = 0; g < own.size(); ++g) {
    if (boxes_.kind(c, g) == RowBoxes::Kind::blocked) continue;
    Candidate& candidate = candidates[count++];
    candidate.group = g;
    candidate.is_minimal = std::binary_search(own.minimal.begin(), own.minimal.end(), g);
    candidate.is_full = false;
    candidate.reach.assign(invariant.begin(), invariant.end());
  }
  candidates.resize(count);
}

/// Its rows within the unit, and the cells from which it does not leave an unsafe end of the row.
void PairProjection::place_follower(Candidate& candidate) {
  const auto ranges = boxes_.ranges(follower_, candidate.group);
  const auto rows = ranges.first(ranges.size() - 1);
  candidate.window = ranges.back();
  const auto known = std::find_if(row_boxes_.begin(), row_boxes_.end(), [&](const auto& box) {
    return std::equal(rows.begin(), rows.end(), box.begin(), box.end());
  });
  candidate.rows = static_cast<std::size_t>(known - row_boxes_.begin());
  if (known == row_boxes_.end()) {
    row_boxes_.emplace_back(rows.begin(), rows.end());
    std::vector<std::int64_t>& list = row_lists_.emplace_back();
    for_each_row(engine_, leading_, rows, counter_, [&](std::int64_t row) { list.push_back(row); });
    taken_.resize(row_boxes_.size() * plane_words_);
  }
  const std::int64_t n = engine_.row_length();
  std::vector<Word>& left = found_;
  left.assign(words_, 0);
  if (ends_.below == Outside::unsafe)
    set_bits(left, 0, std::clamp<std::int64_t>(-std::int64_t{candidate.window.first}, 0, n));
  if (ends_.above == Outside::unsafe)
    set_bits(left, n - std::clamp<std::int64_t>(candidate.window.last, 0, n), n);
  for (std::size_t w = 0; w < words_; ++w) candidate.reach[w] &= ~left[w];
}

/// found_ = the cells of `invariant` from which the follower's box lies in the plane.
void PairProjection::erode(const Plane& plane, const Candidate& follower, ConstRow invariant) {
  Word* const rows = taken_.data() + follower.rows * plane_words_;
  if (is_taken_[follower.rows] == 0) {
    is_taken_[follower.rows] = 1;
    take(plane, row_lists_[follower.rows], rows);
  }
  const auto first = static_cast<std::size_t>(margins_.before + follower.window.first);
  const auto last = static_cast<std::size_t>(margins_.before + follower.window.last);
  for (std::size_t w = 0; w < words_; ++w) {
    Word bits = invariant[w];
    for (std::size_t at = first; at <= last; ++at) bits &= word_from(rows, at + w * kBits);
    found_[w] = bits;
  }
}

/// The AND of some rows of a plane.
void PairProjection::take(const Plane& plane, const std::vector<std::int64_t>& list, Word* rows) const {
  std::fill_n(rows, plane_words_, ~Word{0});
  for (const std::int64_t row : list) {
    const Word* const bits = plane.rows.data() + static_cast<std::size_t>(row) * plane_words_;
    for (std::size_t w = 0; w < plane_words_; ++w) rows[w] &= bits[w];
  }
}

void PairProjection::add(Candidate& candidate, std::vector<Word>& masks) const {
  Word* const mask = masks.data() + candidate.group * words_;
  bool is_full = true;
  for (std::size_t w = 0; w < words_; ++w) {
    mask[w] |= found_[w];
    is_full = is_full && (candidate.reach[w] & ~mask[w]) == 0;
  }
  candidate.is_full = is_full;
}

}  // namespace coordreq
