#include "engine/sum_reader.hpp"

#include <algorithm>

#include "base/requires.hpp"
#include "engine/limits.hpp"
#include "engine/list_numbers.hpp"
#include "engine/row_box.hpp"

namespace coordreq {
namespace {

using Kind = RowSegment::Kind;

constexpr std::size_t kMostSlots = 1024;

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
SumReader<Level>::SumReader(const RowEngine& engine, const LevelRows<Level>& levels)
    : engine_(engine),
      family_(engine.posts()),
      levels_(&levels),
      kernels_(&level_kernels<Level>(best_instruction_set())),
      sums_(&sum_kernels(best_instruction_set())) {
  REQUIRES(!engine.posts().is_cut());
  lay_out_patch();
  find_margins();
  constexpr std::size_t kLanes = kLevelBlock / sizeof(std::int32_t);
  const auto n = static_cast<std::size_t>(levels.row_length());
  offsets_.resize(n + kLanes);
  result_.resize(n + kLevelBlock / sizeof(Level));
  const std::size_t bytes = variants_ * static_cast<std::size_t>(patch_cells_) * sizeof(Level);
  slots_.table.resize(std::clamp<std::size_t>(kPatchBytes / bytes, 2, kMostSlots));
  joined_slots_.table.resize(kJoinedPatches);
}

/// Lays out a patch, with room beyond the domain for the largest box on either side; sizes are row-major over
/// the dimensions.
template <class Level>
void SumReader<Level>::lay_out_patch() {
  const std::size_t outer = engine_.outer();
  const std::size_t inner = engine_.tables() - outer;
  sides_.resize(inner);
  sizes_.resize(inner);
  size_stride_.resize(inner);
  narrowest_.resize(inner);
  reach_.resize(inner);
  widths_.resize(inner);
  rows_.resize(inner);
  taken_.rows.resize(inner);
  std::int64_t stride = 1;
  for (std::size_t i = inner; i-- > 0;) {
    const SumRows& sums = *family_.slices[outer + i].sums;
    const IndexRange widths = sums.widths();
    const auto count = static_cast<std::int32_t>(engine_.grid()[outer + i].count);
    readers_.emplace_back(sums);
    narrowest_[i] = widths.first;
    reach_[i] = widths.last + most_wider(count);
    sizes_[i] = widths.last - widths.first + 1;
    size_stride_[i] = variants_;
    variants_ *= static_cast<std::size_t>(sizes_[i]);
    sides_[i].count = count;
    sides_[i].stride = static_cast<std::int32_t>(stride);
    origin_ += (reach_[i] + 1) * sides_[i].stride;
    stride *= count + 2 * (reach_[i] + 1);
  }
  std::reverse(readers_.begin(), readers_.end());
  // Kernels write whole blocks of levels: the next size begins after the last of them.
  constexpr auto kBlock = static_cast<std::int64_t>(kLevelBlock / sizeof(Level));
  patch_cells_ = (stride + kBlock - 1) / kBlock * kBlock;
  first_offset_ = origin_;
  for (std::size_t i = 0; i < inner; ++i) {
    const std::int64_t size = static_cast<std::int64_t>(size_stride_[i]) * patch_cells_;
    first_offset_ -= narrowest_[i] * static_cast<std::int32_t>(size);
  }
}

template <class Level>
void SumReader<Level>::find_margins() {
  const std::size_t outer = engine_.outer();
  const std::size_t inner = sides_.size();
  std::int64_t cells = 1, in_domain = 1;
  for (std::size_t i = 0; i < inner; ++i) {
    in_domain *= sides_[i].count;
    cells *= sides_[i].count + 2 * (reach_[i] + 1);
  }
  std::vector<std::int32_t> index(inner);
  margins_.reserve(static_cast<std::size_t>(cells - in_domain));
  for (std::size_t i = 0; i < inner; ++i) index[i] = -(reach_[i] + 1);
  for (std::int32_t cell = 0;; ++cell) {
    bool outside = false;
    bool unsafe = false;
    bool safe = false;
    std::int32_t nearest = origin_;
    bool row_start = index[inner - 1] == 0;
    for (std::size_t i = 0; i < inner; ++i) {
      const GridDimension& dimension = engine_.grid()[outer + i];
      const std::int32_t inside = std::clamp(index[i], 0, sides_[i].count - 1);
      nearest += inside * sides_[i].stride;
      if (inside == index[i]) continue;
      const OutsideTraits& rule = traits(index[i] < 0 ? dimension.below : dimension.above);
      outside = true;
      row_start = false;
      unsafe = unsafe || rule.blocks;
      safe = safe || rule.arrives;
    }
    if (row_start) row_offsets_.push_back(cell);
    // A cell beyond an unsafe side is blocked, wherever else it lies; else a cell beyond a safe side is gone.
    if (outside) margins_.push_back({cell, unsafe || safe ? -1 : nearest, unsafe ? Level{0} : kTop});
    std::size_t i = inner;
    while (i-- > 0) {
      if (++index[i] < sides_[i].count + reach_[i] + 1) break;
      if (i == 0) return;
      index[i] = -(reach_[i] + 1);
    }
  }
}

template <class Level>
const Level* SumReader<Level>::minimum(std::span<const std::uint32_t> ids, LaneRange lanes, Level rest) {
  const std::size_t outer = engine_.outer();
  ranges_.resize(outer);
  const Kind kind = lead(ids, ranges_.data());
  for (std::size_t i = 0; i < sides_.size(); ++i) rows_[i] = readers_[i].row(ids[outer + i]);
  return minimum(kind, lanes, rest);
}

template <class Level>
void SumReader<Level>::take(std::span<const std::uint32_t> ids) {
  const std::size_t outer = engine_.outer(), tables = engine_.tables();
  for (std::size_t i = 0; i < sides_.size(); ++i)
    readers_[i].read(ids.subspan(outer + i), tables, taken_.rows[i]);
  taken_.kinds.resize(ids.size() / tables);
  taken_.ranges.resize(taken_.kinds.size() * outer);
  for (std::size_t k = 0; k < taken_.kinds.size(); ++k)
    taken_.kinds[k] = lead(ids.subspan(k * tables), taken_.ranges.data() + k * outer);
}

template <class Level>
const Level* SumReader<Level>::minimum_of(std::size_t choice, LaneRange lanes, Level rest) {
  const IndexRange* const ranges = taken_.ranges.data() + choice * engine_.outer();
  ranges_.assign(ranges, ranges + engine_.outer());
  for (std::size_t i = 0; i < sides_.size(); ++i) rows_[i] = taken_.rows[i][choice];
  return minimum(taken_.kinds[choice], lanes, rest);
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

/// The minimum of the box in ranges_ and rows_.
template <class Level>
const Level* SumReader<Level>::minimum(Kind kind, LaneRange lanes, Level rest) {
  if (kind == Kind::blocked) {
    std::fill_n(result_.begin(), lanes.size(), Level{0});
    fill_rest(lanes, rest);
    return result_.data();
  }
  // Posts that have left for good share a patch: only inner dimensions, by an unsafe side, make a difference.
  if (kind == Kind::gone) ranges_.assign(ranges_.size(), {0, -1});
  fetch(slot(slots_, {}, kind == Kind::gone), lanes, rest);
  return result_.data();
}

template <class Level>
const Level* SumReader<Level>::bound(std::size_t begin, std::size_t end, LaneRange lanes) {
  if (!join(begin, end)) return nullptr;
  fetch(slot(joined_slots_, widths_, false), lanes, kTop);
  return result_.data();
}

/// ranges_, rows_ and widths_ = a box around those of some choices: the least lower and greatest upper ends.
/// @returns false if there is no such box, or it is not small
template <class Level>
bool SumReader<Level>::join(std::size_t begin, std::size_t end) {
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const SumRows::Rows& rows = taken_.rows[i];
    if (!rows.has_one_profile) return false;
    SumRows::Row both = rows[begin];
    for (std::size_t k = begin + 1; k < end; ++k) {
      both.lower = std::min(both.lower, rows.lower[k]);
      both.upper = std::max(both.upper, rows.upper[k]);
    }
    rows_[i] = both;
    widths_[i] = greatest_width(i, both);
    if (widths_[i] > reach_[i]) return false;
  }
  const std::size_t outer = engine_.outer();
  const auto ranges = [&](std::size_t k) { return taken_.ranges.data() + k * outer; };
  ranges_.assign(ranges(begin), ranges(begin) + outer);
  for (std::size_t k = begin; k < end; ++k) {
    if (taken_.kinds[k] != Kind::fixed) return false;
    for (std::size_t t = 0; t < outer; ++t)
      ranges_[t] = around_both(ranges_[t], ranges(k)[t], engine_.grid()[t]);
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

/// result_ = the levels of the boxes in rows_, in some lanes of a row.
template <class Level>
void SumReader<Level>::fetch(const Slot& slot, LaneRange lanes, Level rest) {
  const bool has_all_sizes = slot.widths.empty();
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    BoxSides& side = sides_[i];
    const SumRows& sums = *family_.slices[engine_.outer() + i].sums;
    side.lower_profile = sums.profile_lower(rows_[i].profile).from(lanes.begin);
    side.upper_profile = sums.profile_upper(rows_[i].profile).from(lanes.begin);
    side.lower = rows_[i].lower;
    side.upper = rows_[i].upper;
    const std::int64_t stride = static_cast<std::int64_t>(size_stride_[i]) * patch_cells_;
    side.width_stride = has_all_sizes ? static_cast<std::int32_t>(stride) : 0;
  }
  const std::size_t n = lanes.size();
  sums_->find_offsets(sides_.data(), sides_.size(), has_all_sizes ? first_offset_ : origin_, offsets_.data(),
                      n);
  // By local pointers: else compilers allow for bytes written to be those of the vectors themselves.
  const Level* const levels = slot.levels;
  const std::int32_t* const offset = offsets_.data();
  Level* const result = result_.data();
  for (std::size_t c = 0; c < n; ++c) result[c] = levels[offset[c]];
  fill_rest(lanes, rest);
}

template <class Level>
void SumReader<Level>::fill_rest(LaneRange lanes, Level rest) {
  std::fill_n(result_.begin() + static_cast<std::ptrdiff_t>(lanes.size()), kLevelBlock / sizeof(Level), rest);
}

/// The patch for the leading ranges_, eroded by boxes of one size, or of all sizes.
template <class Level>
typename SumReader<Level>::Slot& SumReader<Level>::slot(Slots& slots, const std::vector<std::int32_t>& widths,
                                                        bool gone) {
  std::uint64_t hash = 0;
  for (const IndexRange& range : ranges_) {
    hash = mixed_hash(hash, static_cast<std::uint32_t>(range.first));
    hash = mixed_hash(hash, static_cast<std::uint32_t>(range.last));
  }
  for (const std::int32_t width : widths) hash = mixed_hash(hash, static_cast<std::uint32_t>(width));
  // A few slots are looked at; where all are taken the last one is used again.
  constexpr std::size_t kProbes = 4;
  std::vector<Slot>& table = slots.table;
  std::size_t at = (hash >> 32) % table.size();
  for (std::size_t probe = 0; probe < kProbes; ++probe, at = (at + 1) % table.size()) {
    Slot& candidate = table[at];
    const bool is_taken = candidate.epoch == epoch_;
    if (is_taken && candidate.ranges == ranges_ && candidate.widths == widths) return candidate;
    if (is_taken && probe + 1 < kProbes) continue;
    if (!is_taken) candidate.levels = next_buffer(slots, widths.empty() ? variants_ : 1);
    candidate.epoch = epoch_;
    candidate.ranges = ranges_;
    candidate.widths = widths;
    fill(candidate, gone);
    return candidate;
  }
  return table[at];  // not reached
}

template <class Level>
Level* SumReader<Level>::next_buffer(Slots& slots, std::size_t sizes) const {
  if (slots.used == slots.buffers.size()) {
    // Erosion reads beyond a patch, from the one after it; those levels make no difference.
    std::int64_t beyond = 0;
    for (std::size_t i = 0; i < sides_.size(); ++i) beyond += std::int64_t{reach_[i] + 1} * sides_[i].stride;
    slots.buffers.emplace_back(sizes * static_cast<std::size_t>(patch_cells_) +
                               static_cast<std::size_t>(beyond) + kLevelBlock);
  }
  return slots.buffers[slots.used++].data();
}

template <class Level>
void SumReader<Level>::fill(Slot& slot, bool gone) {
  const std::size_t sizes = slot.widths.empty() ? variants_ : 1;
  fill_patch(slot, gone);
  erode_patch(slot, slot.widths.empty() ? narrowest_ : slot.widths);
  for (std::size_t size = 1; size < sizes; ++size) erode(slot, size);
}

/// Fills a patch with the minima over the leading dimensions, and its margins.
template <class Level>
void SumReader<Level>::fill_patch(Slot& slot, bool gone) {
  const auto n = static_cast<std::size_t>(levels_->row_length());
  for (std::size_t inner = 0; inner < row_offsets_.size(); ++inner) {
    Level* target = slot.levels + row_offsets_[inner];
    if (gone) {
      std::fill_n(target, n, kTop);
      continue;
    }
    list_rows(engine_.grid(), 0, slot.ranges, counter_, sources_,
              [&](std::int64_t first) { return levels_->row(first + static_cast<std::int64_t>(inner)); });
    kernels_->minimum(sources_.data(), sources_.size(), target, n);
  }
  for (const Margin& margin : margins_) {
    slot.levels[margin.cell] = margin.source < 0 ? margin.constant : slot.levels[margin.source];
  }
}

/// Each cell of the first patch becomes the minimum of the box that begins there: one dimension at a time, by
/// doubling.
template <class Level>
void SumReader<Level>::erode_patch(Slot& slot, const std::vector<std::int32_t>& widths) {
  Level* patch = slot.levels;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    for (std::int32_t done = 1; done < widths[i] + 1;) {
      const std::int32_t step = std::min(done, widths[i] + 1 - done);
      const Level* pair[] = {patch, patch + std::int64_t{step} * sides_[i].stride};
      kernels_->minimum(pair, 2, patch, static_cast<std::size_t>(patch_cells_));
      done += step;
    }
  }
}

/// Makes the patch of a size from that of a smaller one: a box is the union of two that are one index shorter
/// in some dimension.
template <class Level>
void SumReader<Level>::erode(Slot& slot, std::size_t size) {
  std::size_t i = 0;
  while (size / size_stride_[i] % static_cast<std::size_t>(sizes_[i]) == 0) ++i;
  const auto cells = static_cast<std::size_t>(patch_cells_);
  const Level* shorter = slot.levels + (size - size_stride_[i]) * cells;
  const Level* pair[] = {shorter, shorter + sides_[i].stride};
  kernels_->minimum(pair, 2, slot.levels + size * cells, cells);
}

template class SumReader<std::uint8_t>;
template class SumReader<std::uint16_t>;
template class SumReader<std::uint32_t>;
template class SumReader<std::uint64_t>;

}  // namespace coordreq
