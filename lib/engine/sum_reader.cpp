#include "engine/sum_reader.hpp"

#include <algorithm>
#include <utility>

#include "base/requires.hpp"
#include "engine/list_numbers.hpp"

namespace coordreq {
namespace {

using Kind = RowSegment::Kind;

constexpr std::size_t kSlots = 256;

/// So little, where others want the core, a thread waits for a patch before it sleeps.
constexpr int kLeastLooks = 16;

/// A range that holds both; on a ring with its first index in the domain.
IndexRange around_both(IndexRange one, IndexRange other, const GridDimension& dimension) {
  const auto n = static_cast<std::int32_t>(dimension.count);
  if (dimension.periodic() && other.first - one.first > n / 2) other = {other.first - n, other.last - n};
  if (dimension.periodic() && one.first - other.first > n / 2) other = {other.first + n, other.last + n};
  IndexRange both{std::min(one.first, other.first), std::max(one.last, other.last)};
  if (!dimension.periodic()) return both;
  if (both.last - both.first + 1 >= n) return {0, n - 1};
  if (both.first < 0) both = {both.first + n, both.last + n};
  return both;
}

}  // namespace

template <class Level>
SumReader<Level>::SumReader(const RowEngine& engine, std::shared_ptr<SumPatches<Level>> patches)
    : engine_(engine),
      family_(engine.posts()),
      patches_(std::move(patches)),
      sums_(&sum_kernels(best_instruction_set())),
      slots_(kSlots),
      wait_(kLeastLooks) {
  REQUIRES(!engine.posts().is_cut());
  const std::vector<PatchLayout::Side>& sides = patches_->layout().sides;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    readers_.emplace_back(*family_.slices[engine.outer() + i].sums);
    sides_.push_back({.count = sides[i].count, .stride = sides[i].stride});
  }
  rows_.resize(sides.size());
  choices_.rows.resize(sides.size());
  constexpr std::size_t kLanes = kLevelBlock / sizeof(std::int32_t);
  const std::size_t n = engine.all_lanes().size();
  offsets_.resize(n + kLanes);
  result_.resize(n + kLevelBlock / sizeof(Level));
}

template <class Level>
const Level* SumReader<Level>::minimum(std::span<const std::uint32_t> ids, LaneRange lanes, Level rest) {
  const std::size_t outer = engine_.outer();
  box_.ranges.resize(outer);
  const Kind kind = lead(ids, box_.ranges.data());
  for (std::size_t i = 0; i < sides_.size(); ++i) rows_[i] = readers_[i].row(ids[outer + i]);
  return minimum(kind, lanes, rest);
}

template <class Level>
void SumReader<Level>::take(std::span<const std::uint32_t> ids) {
  const std::size_t outer = engine_.outer(), tables = engine_.tables();
  for (std::size_t i = 0; i < sides_.size(); ++i)
    readers_[i].read(ids.subspan(outer + i), tables, choices_.rows[i]);
  choices_.kinds.resize(ids.size() / tables);
  choices_.ranges.resize(choices_.kinds.size() * outer);
  for (std::size_t k = 0; k < choices_.kinds.size(); ++k)
    choices_.kinds[k] = lead(ids.subspan(k * tables), choices_.ranges.data() + k * outer);
}

template <class Level>
const Level* SumReader<Level>::minimum_of(std::size_t choice, LaneRange lanes, Level rest) {
  const IndexRange* const ranges = choices_.ranges.data() + choice * engine_.outer();
  box_.ranges.assign(ranges, ranges + engine_.outer());
  for (std::size_t i = 0; i < sides_.size(); ++i) rows_[i] = choices_.rows[i][choice];
  return minimum(choices_.kinds[choice], lanes, rest);
}

/// The kind of the slices of the leading dimensions together; if it is `fixed` their ranges.
template <class Level>
RowSegment::Kind SumReader<Level>::lead(std::span<const std::uint32_t> ids, IndexRange* ranges) const {
  Kind kind = Kind::fixed;
  for (std::size_t t = 0; t < engine_.outer(); ++t) {
    const RowSegment& segment = family_.slices[t].slices[ids[t]][0];
    if (segment.kind == Kind::blocked || (segment.kind == Kind::gone && kind == Kind::fixed))
      kind = segment.kind;
    ranges[t] = segment.range;
  }
  return kind;
}

/// The minimum of the box in box_ and rows_.
template <class Level>
const Level* SumReader<Level>::minimum(Kind kind, LaneRange lanes, Level rest) {
  if (kind == Kind::blocked) {
    std::fill_n(result_.begin(), lanes.size(), Level{0});
    fill_rest(lanes, rest);
    return result_.data();
  }
  // Posts that have left for good share a patch: only inner dimensions, by an unsafe side, make a difference.
  if (kind == Kind::gone) box_.ranges.assign(box_.ranges.size(), {0, -1});
  box_.widths.clear();
  fetch(patch(), lanes, rest);
  return result_.data();
}

template <class Level>
const Level* SumReader<Level>::bound(std::size_t begin, std::size_t end, LaneRange lanes) {
  if (!join(begin, end)) return nullptr;
  fetch(patch(), lanes, kTop);
  return result_.data();
}

/// box_ and rows_ = a box around those of some choices: the least lower and greatest upper ends.
/// @returns false if there is no such box, or it is not small
template <class Level>
bool SumReader<Level>::join(std::size_t begin, std::size_t end) {
  box_.widths.resize(sides_.size());
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const SumRows::Rows& rows = choices_.rows[i];
    if (!rows.has_one_profile) return false;
    SumRows::Row both = rows[begin];
    for (std::size_t k = begin + 1; k < end; ++k) {
      both.lower = std::min(both.lower, rows.lower[k]);
      both.upper = std::max(both.upper, rows.upper[k]);
    }
    rows_[i] = both;
    box_.widths[i] = greatest_width(i, both);
    if (box_.widths[i] > patches_->layout().sides[i].reach) return false;
  }
  const std::size_t outer = engine_.outer();
  const auto ranges = [&](std::size_t k) { return choices_.ranges.data() + k * outer; };
  box_.ranges.assign(ranges(begin), ranges(begin) + outer);
  for (std::size_t k = begin; k < end; ++k) {
    if (choices_.kinds[k] != Kind::fixed) return false;
    for (std::size_t t = 0; t < outer; ++t)
      box_.ranges[t] = around_both(box_.ranges[t], ranges(k)[t], engine_.grid()[t]);
  }
  return true;
}

/// The greatest last - first of a cell in an inner dimension: floor(a + d) - floor(a) is floor(d) or one
/// more.
template <class Level>
std::int32_t SumReader<Level>::greatest_width(std::size_t i, const SumRows::Row& row) const {
  const SumRows& sums = *family_.slices[engine_.outer() + i].sums;
  const std::int64_t difference = row.upper - row.lower + sums.widest(row.profile);
  return static_cast<std::int32_t>((difference >> TransitionTable::kFractionBits) + 1);
}

/// result_ = the levels of the boxes in box_ and rows_, in some lanes of a row.
template <class Level>
void SumReader<Level>::fetch(const Level* patch, LaneRange lanes, Level rest) {
  const PatchLayout& layout = patches_->layout();
  const bool has_all_sizes = box_.widths.empty();
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    BoxSides& side = sides_[i];
    const SumRows& sums = *family_.slices[engine_.outer() + i].sums;
    side.lower_profile = sums.profile_lower(rows_[i].profile).from(lanes.begin);
    side.upper_profile = sums.profile_upper(rows_[i].profile).from(lanes.begin);
    side.lower = rows_[i].lower;
    side.upper = rows_[i].upper;
    const std::int64_t stride = static_cast<std::int64_t>(layout.sides[i].size_stride) * layout.cells;
    side.width_stride = has_all_sizes ? static_cast<std::int32_t>(stride) : 0;
  }
  const std::size_t n = lanes.size();
  sums_->find_offsets(sides_.data(), sides_.size(), has_all_sizes ? layout.first_offset : layout.origin,
                      offsets_.data(), n);
  // By local pointers: else compilers allow for bytes written to be those of the vectors themselves.
  const std::int32_t* const offset = offsets_.data();
  Level* const result = result_.data();
  for (std::size_t c = 0; c < n; ++c) result[c] = patch[offset[c]];
  fill_rest(lanes, rest);
}

template <class Level>
void SumReader<Level>::fill_rest(LaneRange lanes, Level rest) {
  std::fill_n(result_.begin() + static_cast<std::ptrdiff_t>(lanes.size()), kLevelBlock / sizeof(Level), rest);
}

/// The patch for box_.
template <class Level>
const Level* SumReader<Level>::patch() {
  std::uint64_t hash = 0;
  for (const IndexRange& range : box_.ranges) {
    hash = mixed_hash(hash, static_cast<std::uint32_t>(range.first));
    hash = mixed_hash(hash, static_cast<std::uint32_t>(range.last));
  }
  for (const std::int32_t width : box_.widths) hash = mixed_hash(hash, static_cast<std::uint32_t>(width));
  // A few slots are looked at; where all are taken the last one is used again.
  constexpr std::size_t kProbes = 4;
  std::size_t at = (hash >> 32) % kSlots;
  for (std::size_t probe = 1; slots_[at].epoch == epoch_; ++probe, at = (at + 1) % kSlots) {
    if (slots_[at].key == box_) return slots_[at].levels;
    if (probe == kProbes) break;
  }
  Slot* slot = &slots_[at];
  const Level* levels = patches_->find(*unit_, box_, wait_);
  if (levels == nullptr) {
    slot = &private_slot_;
    if (slot->epoch == epoch_ && slot->key == box_) return slot->levels;
    patches_->make(*unit_, box_, private_patch_);
    levels = private_patch_.data();
  }
  slot->key = box_;
  slot->epoch = epoch_;
  slot->levels = levels;
  return levels;
}

template class SumReader<std::uint8_t>;
template class SumReader<std::uint16_t>;
template class SumReader<std::uint32_t>;
template class SumReader<std::uint64_t>;

}  // namespace coordreq
