#include "choices/pair_projection.hpp"

#include <algorithm>
#include <numeric>

#include "base/fast_paths.hpp"
#include "base/requires.hpp"
#include "engine/row_box.hpp"

namespace coordreq {
namespace {

constexpr auto kBits = static_cast<std::size_t>(CellSet::kWordBits);
/// Number of rows of K that are kept with their margins.
constexpr std::int64_t kContinued = 512;

}  // namespace

PairProjection::PairProjection(const Controller& controller, const RowBoxes& boxes, std::size_t classes)
    : controller_(controller),
      boxes_(boxes),
      engine_(*controller.engine),
      kernels_(&bit_kernels(best_instruction_set())) {
  if (!fast_paths().pair_projections || classes != 2 || !boxes.is_product()) return;
  if (boxes.moved(0).empty() || boxes.moved(1).empty()) return;
  applies_ = true;
  leader_ = boxes.moved(0).back() < boxes.moved(1).back() ? 0 : 1;
  follower_ = 1 - leader_;
  const std::size_t moved = boxes.moved(leader_).size();
  // Dimensions ascend: the leader has the first ones if its last one comes before all of the follower's.
  const bool leads = boxes.moved(leader_).back() < boxes.moved(follower_).front() &&
                     moved <= engine_.across() && engine_.is_closed(moved);
  leading_ = leads ? moved : 0;
  unit_rows_ = leads ? engine_.grid().row_stride(leading_ - 1) : 1;
  words_ = engine_.row_words();
  shape_ = engine_.posts().shape;
  margins_ = shape_.margins();
  find_beyond();
  // Room for the whole last word, wherever a window begins, and the one after it.
  const RowMargins fastest = shape_.dimensions.back().margins;
  gathered_words_ = static_cast<std::size_t>(fastest.before + fastest.after) / kBits + words_ + 2;
  plane_words_ = static_cast<std::size_t>(margins_.before + margins_.after) / kBits + gathered_words_ + 2;
  result_.resize(words_);
  if (!leads) continued_.resize(static_cast<std::size_t>(std::min(engine_.rows(), kContinued)));
  box_.resize(engine_.grid());
}

void PairProjection::find_masks(const RowPosition& position, const RowGroups& groups,
                                std::vector<std::vector<Word>>& masks) {
  REQUIRES(applies_ && !boxes_.has_gone() && engine_.allow() == nullptr);
  REQUIRES(controller_.synthesis == Synthesis::maximal && !controller_.approaches);
  const ConstRow invariant = controller_.invariant->row(position.row);
  enter_unit(position, *groups.classes[leader_]);
  row_boxes_.clear();
  row_lists_.clear();
  list(groups, leader_, invariant, leaders_);
  list(groups, follower_, invariant, followers_);
  for (Candidate& candidate : followers_) locate_follower(candidate);
  for (std::size_t c = 0; c < 2; ++c) masks[c].assign(groups.classes[c]->size() * words_, 0);
  for (Candidate& leader : leaders_) {
    is_gathered_.assign(row_boxes_.size(), 0);
    for (Candidate& follower : followers_) {
      // Each class tries the smallest boxes of the other.
      const bool for_leader = follower.is_minimal && !leader.is_full;
      const bool for_follower = leader.is_minimal && !follower.is_full;
      if (!for_leader && !for_follower) continue;
      erode(leader, follower, invariant);
      if (for_leader) add(leader, masks[leader_]);
      if (for_follower) add(follower, masks[follower_]);
    }
  }
}

void PairProjection::enter_unit(const RowPosition& position, const ActionGroups& groups) {
  const std::int64_t unit = position.row / unit_rows_;
  if (leading_ == 0 || unit == unit_) return;
  unit_ = unit;
  planes_.resize(groups.size());
  for (Plane& plane : planes_) plane.is_known = false;
}

/// @pre the group's post is a box
const PairProjection::Plane& PairProjection::plane(std::uint32_t group) {
  REQUIRES(boxes_.kind(leader_, group) == RowBoxes::Kind::box);
  Plane& plane = planes_[group];
  if (plane.is_known) return plane;
  plane.is_known = true;
  plane.rows.assign(static_cast<std::size_t>(unit_rows_) * plane_words_, 0);
  std::vector<Word> row(words_);
  for (std::int64_t inner = 0; inner < unit_rows_; ++inner) {
    row.assign(words_, ~Word{0});
    for_each_row(engine_.grid(), 0, boxes_.ranges(leader_, group), counter_, [&](std::int64_t first) {
      const ConstRow target = controller_.target().row(first + inner);
      for (std::size_t w = 0; w < words_; ++w) row[w] &= target[w];
    });
    continue_row(row, plane.rows.data() + static_cast<std::size_t>(inner) * plane_words_);
  }
  return plane;
}

const std::vector<Word>& PairProjection::continued(std::int64_t row) {
  Continued& kept = continued_[static_cast<std::size_t>(row % kContinued) % continued_.size()];
  if (kept.row == row) return kept.bits;
  kept.row = row;
  kept.bits.assign(plane_words_, 0);
  continue_row(controller_.target().row(row), kept.bits.data());
  return kept.bits;
}

/// Which lanes beyond the ends repeat which cells is the same for all rows: it is read off a row whose levels
/// are the numbers of its lanes.
void PairProjection::find_beyond() {
  LevelRows<std::uint32_t> numbers(1, shape_);
  std::vector<std::uint32_t> cleared;
  numbers.change_row(0, [&](std::uint32_t* row) {
    std::iota(row, row + shape_.length(), std::uint32_t{1});
    numbers.clear_gaps(row);
    cleared.assign(row - margins_.before, row + shape_.length() + margins_.after);
  });
  const std::uint32_t* const row = numbers.row(0);
  for (std::size_t lane = 0; lane < cleared.size(); ++lane) {
    const std::uint32_t number = row[static_cast<std::int64_t>(lane) - margins_.before];
    if (cleared[lane] != 0 || number == 0) continue;
    beyond_.push_back(
        {lane, number == LevelRows<std::uint32_t>::kTop ? -1 : static_cast<std::int64_t>(number) - 1});
  }
}

/// Copies a row to margins().before, and continues it beyond its ends.
void PairProjection::continue_row(ConstRow row, Word* out) const {
  const auto before = static_cast<std::size_t>(margins_.before);
  for (std::size_t w = 0; w < words_; ++w) {
    const std::size_t word = w + before / kBits;
    const std::size_t shift = before % kBits;
    out[word] |= row[w] << shift;
    if (shift != 0) out[word + 1] |= row[w] >> (kBits - shift);
  }
  for (const Beyond& beyond : beyond_) {
    const auto source = static_cast<std::size_t>(beyond.source);
    const bool member = beyond.source < 0 || (row[source / kBits] >> (source % kBits) & 1) != 0;
    out[beyond.lane / kBits] |= Word{member ? 1U : 0U} << (beyond.lane % kBits);
  }
}

/// Lists the groups of a class that may be found, with the cells from which they do not leave an unsafe end
/// of the row.
void PairProjection::list(const RowGroups& groups, std::size_t c, ConstRow invariant,
                          std::vector<Candidate>& candidates) {
  const ActionGroups& class_groups = *groups.classes[c];
  const std::vector<std::size_t>& moved = boxes_.moved(c);
  candidates.resize(class_groups.size());
  std::size_t count = 0;
  for (std::uint32_t g = 0; g < class_groups.size(); ++g) {
    if (boxes_.kind(c, g) == RowBoxes::Kind::blocked) continue;
    Candidate& candidate = candidates[count++];
    candidate.group = g;
    candidate.is_minimal = std::binary_search(class_groups.minimal.begin(), class_groups.minimal.end(), g);
    candidate.is_full = false;
    candidate.reach.assign(invariant.begin(), invariant.end());
    result_.assign(words_, 0);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      if (moved[i] >= engine_.across())
        mark_leaving(shape_, moved[i] - engine_.across(), boxes_.ranges(c, g)[i], result_);
    }
    for (std::size_t w = 0; w < words_; ++w) candidate.reach[w] &= ~result_[w];
  }
  candidates.resize(count);
}

/// Finds the rows and lanes that a follower reads within the unit.
void PairProjection::locate_follower(Candidate& candidate) {
  const auto ranges = boxes_.ranges(follower_, candidate.group);
  const auto all_but_one = ranges.first(ranges.size() - 1);
  candidate.window = ranges.back();
  const auto known = std::find_if(row_boxes_.begin(), row_boxes_.end(), [&](const auto& box) {
    return std::equal(all_but_one.begin(), all_but_one.end(), box.begin(), box.end());
  });
  candidate.rows = static_cast<std::size_t>(known - row_boxes_.begin());
  if (known == row_boxes_.end()) {
    row_boxes_.emplace_back(all_but_one.begin(), all_but_one.end());
    row_lists_.emplace_back();
    if (leading_ > 0) list_positions(all_but_one, row_lists_.back());
    gathered_.resize(row_boxes_.size() * gathered_words_);
  }
}

/// Finds the lanes to which the windows of all dimensions but the fastest lead.
void PairProjection::list_lanes(std::span<const IndexRange> windows) {
  // Lanes are counted so that the first of them is 0; erode() adds the first offset of the fastest window.
  lanes_.assign(1, margins_.before - shape_.dimensions.back().margins.before);
  for (std::size_t k = 0; k < windows.size(); ++k) {
    const IndexRange window = windows[k];
    const std::size_t size = lanes_.size();
    for (std::int64_t offset = window.first; offset <= window.last; ++offset) {
      for (std::size_t i = 0; i < size; ++i)
        lanes_.push_back(lanes_[i] + offset * shape_.dimensions[k].stride);
    }
    lanes_.erase(lanes_.begin(), lanes_.begin() + static_cast<std::ptrdiff_t>(size));
  }
}

/// Finds the rows of a box, with these lanes in each.
void PairProjection::list_positions(std::span<const IndexRange> box, std::vector<Position>& positions) {
  const std::size_t windows = engine_.along() - 1;
  list_lanes(box.last(windows));
  for_each_row(engine_.grid(), leading_, box.first(box.size() - windows), counter_, [&](std::int64_t row) {
    for (const std::int64_t lane : lanes_) positions.push_back({row, static_cast<std::size_t>(lane)});
  });
}

/// result_ = the cells of `invariant` from which the box of leader and follower lies in K.
void PairProjection::erode(const Candidate& leader, const Candidate& follower, ConstRow invariant) {
  Word* const rows = gathered_.data() + follower.rows * gathered_words_;
  if (is_gathered_[follower.rows] == 0 && leading_ > 0)
    gather(plane(leader.group), row_lists_[follower.rows], rows);
  if (is_gathered_[follower.rows] == 0 && leading_ == 0) gather(leader, follower, rows);
  is_gathered_[follower.rows] = 1;
  const std::int64_t before = shape_.dimensions.back().margins.before;
  const auto first = static_cast<std::size_t>(before + follower.window.first);
  const auto last = static_cast<std::size_t>(before + follower.window.last);
  std::copy(invariant.begin(), invariant.end(), result_.begin());
  kernels_->and_shifted(rows, first, last - first + 1, result_.data(), words_);
}

/// The AND of the bits from some places of a plane on, as far as windows along the fastest dimension reach.
void PairProjection::gather(const Plane& plane, const std::vector<Position>& list, Word* rows) const {
  std::fill_n(rows, gathered_words_, ~Word{0});
  for (const Position& position : list) {
    const Word* const bits = plane.rows.data() + static_cast<std::size_t>(position.row) * plane_words_;
    kernels_->and_shifted(bits, position.lane, 1, rows, gathered_words_);
  }
}

/// gather() from the rows of K in the box of leader and follower.
void PairProjection::gather(const Candidate& leader, const Candidate& follower, Word* rows) {
  boxes_.put(leader_, boxes_.ranges(leader_, leader.group), box_);
  boxes_.put(follower_, boxes_.ranges(follower_, follower.group), box_);
  all_.assign(plane_words_, ~Word{0});
  for_each_row(engine_.grid(), 0, box_.ranges, counter_, [&](std::int64_t row) {
    const std::vector<Word>& bits = continued(row);
    for (std::size_t w = 0; w < plane_words_; ++w) all_[w] &= bits[w];
  });
  list_lanes(std::span<const IndexRange>(box_.windows).first(engine_.along() - 1));
  std::fill_n(rows, gathered_words_, ~Word{0});
  for (const std::int64_t lane : lanes_)
    kernels_->and_shifted(all_.data(), static_cast<std::size_t>(lane), 1, rows, gathered_words_);
}

void PairProjection::add(Candidate& candidate, std::vector<Word>& masks) const {
  candidate.is_full =
      kernels_->join(result_.data(), candidate.reach.data(), masks.data() + candidate.group * words_, words_);
}

}  // namespace coordreq
