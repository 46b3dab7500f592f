#include "engine/sum_reader.hpp"

#include <algorithm>

#include "engine/limits.hpp"
#include "engine/row_box.hpp"

namespace coordreq {
namespace {

using Kind = RowSegment::Kind;

constexpr std::size_t kMostSlots = 1024;

}  // namespace

template <class Level>
SumReader<Level>::SumReader(const RowEngine& engine, const LevelRows<Level>& levels)
    : engine_(engine),
      family_(engine.posts()),
      levels_(levels),
      kernels_(&level_kernels<Level>(best_instruction_set())),
      sums_(&sum_kernels(best_instruction_set())) {
  lay_out_block();
  find_margins();
  constexpr std::size_t kLanes = kLevelBlock / sizeof(std::int32_t);
  const auto n = static_cast<std::size_t>(levels.row_length());
  place_.resize(n + kLanes);
  result_.resize(n + kLevelBlock / sizeof(Level));
  const std::size_t bytes = variants_ * static_cast<std::size_t>(block_cells_) * sizeof(Level);
  slots_.resize(std::clamp<std::size_t>(kBlockBytes / bytes, 2, kMostSlots));
}

/// Room beyond the domain for the largest box on either side, sizes row-major over the dimensions.
template <class Level>
void SumReader<Level>::lay_out_block() {
  const std::size_t outer = engine_.outer();
  const std::size_t inner = engine_.tables() - outer;
  sides_.resize(inner);
  sizes_.resize(inner);
  size_stride_.resize(inner);
  widest_.resize(inner);
  std::int64_t stride = 1;
  for (std::size_t i = inner; i-- > 0;) {
    const SumRows& sums = *family_.slices[outer + i].sums;
    const IndexRange widths = sums.widths();
    const auto count = static_cast<std::int32_t>(engine_.grid()[outer + i].count);
    readers_.emplace_back(sums);
    widest_[i] = widths.last;
    sizes_[i] = widths.last - widths.first + 1;
    size_stride_[i] = variants_;
    variants_ *= static_cast<std::size_t>(sizes_[i]);
    sides_[i].count = count;
    sides_[i].stride = static_cast<std::int32_t>(stride);
    origin_ += (widths.last + 1) * sides_[i].stride;
    stride *= count + 2 * (widths.last + 1);
  }
  std::reverse(readers_.begin(), readers_.end());
  // Kernels write whole blocks of levels: the next size begins after the last of them.
  constexpr auto kBlock = static_cast<std::int64_t>(kLevelBlock / sizeof(Level));
  block_cells_ = (stride + kBlock - 1) / kBlock * kBlock;
  first_place_ = origin_;
  for (std::size_t i = 0; i < inner; ++i) {
    sides_[i].width_stride =
        static_cast<std::int32_t>(static_cast<std::int64_t>(size_stride_[i]) * block_cells_);
    first_place_ -= (widest_[i] - sizes_[i] + 1) * sides_[i].width_stride;
  }
}

template <class Level>
void SumReader<Level>::find_margins() {
  const std::size_t outer = engine_.outer();
  const std::size_t inner = sides_.size();
  std::vector<std::int32_t> index(inner);
  for (std::size_t i = 0; i < inner; ++i) index[i] = -(widest_[i] + 1);
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
    if (row_start) places_of_rows_.push_back(cell);
    // What leaves through an unsafe side is blocked, wherever else it leaves; else it may have left for good.
    if (outside) margins_.push_back({cell, unsafe || safe ? -1 : nearest, unsafe ? Level{0} : kTop});
    std::size_t i = inner;
    while (i-- > 0) {
      if (++index[i] < sides_[i].count + widest_[i] + 1) break;
      if (i == 0) return;
      index[i] = -(widest_[i] + 1);
    }
  }
}

template <class Level>
const Level* SumReader<Level>::minimum(std::span<const std::uint32_t> ids) {
  const std::size_t outer = engine_.outer();
  const auto n = static_cast<std::size_t>(levels_.row_length());
  bool gone = false;
  if (!choose_outer(ids, gone)) {
    std::fill(result_.begin(), result_.end(), Level{0});
    return result_.data();
  }
  Slot& taken = slot(gone);
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const SumRows::Row row = readers_[i].row(ids[outer + i]);
    sides_[i].lower_run = row.run_lower;
    sides_[i].upper_run = row.run_upper;
    sides_[i].lower = row.lower;
    sides_[i].upper = row.upper;
  }
  sums_->find_places(sides_.data(), sides_.size(), first_place_, place_.data(), n);
  const Level* levels = taken.levels.data();
  for (std::size_t c = 0; c < n; ++c) result_[c] = levels[place_[c]];
  return result_.data();
}

/// Sets ranges_ to the box of the leading dimensions. @returns false if it is blocked
template <class Level>
bool SumReader<Level>::choose_outer(std::span<const std::uint32_t> ids, bool& gone) {
  ranges_.resize(engine_.outer());
  for (std::size_t t = 0; t < engine_.outer(); ++t) {
    const RowSegment& segment = family_.slices[t].slices[ids[t]][0];
    if (segment.kind == Kind::blocked) return false;
    gone = gone || segment.kind == Kind::gone;
    ranges_[t] = segment.range;
  }
  // All that has left for good is alike, but for what else leaves through an unsafe side.
  if (gone) ranges_.assign(ranges_.size(), {0, -1});
  return true;
}

/// The block for the leading ranges.
template <class Level>
typename SumReader<Level>::Slot& SumReader<Level>::slot(bool gone) {
  std::uint64_t hash = 0;
  for (const IndexRange& range : ranges_) {
    hash = (hash ^ static_cast<std::uint32_t>(range.first)) * 0x9E3779B97F4A7C15U;
    hash = (hash ^ static_cast<std::uint32_t>(range.last)) * 0x9E3779B97F4A7C15U;
  }
  // A few places to look; where all are taken the last gives way.
  constexpr std::size_t kProbes = 4;
  std::size_t at = (hash >> 32) % slots_.size();
  for (std::size_t probe = 0; probe < kProbes; ++probe, at = (at + 1) % slots_.size()) {
    Slot& candidate = slots_[at];
    if (candidate.epoch == epoch_ && candidate.ranges == ranges_) return candidate;
    if (candidate.epoch == epoch_ && probe + 1 < kProbes) continue;
    candidate.epoch = epoch_;
    candidate.ranges = ranges_;
    fill_block(candidate, gone);
    return candidate;
  }
  return slots_[at];  // not reached
}

/// The minima over the leading dimensions, with margins, eroded by the smallest boxes.
template <class Level>
void SumReader<Level>::fill_block(Slot& slot, bool gone) {
  // What erosion reads beyond a block is in the one after it, and makes no difference.
  std::int64_t reach = 0;
  for (std::size_t i = 0; i < sides_.size(); ++i) reach += std::int64_t{widest_[i] + 1} * sides_[i].stride;
  slot.levels.resize(variants_ * static_cast<std::size_t>(block_cells_) + static_cast<std::size_t>(reach) +
                     kLevelBlock);
  const auto n = static_cast<std::size_t>(levels_.row_length());
  for (std::size_t inner = 0; inner < places_of_rows_.size(); ++inner) {
    Level* target = slot.levels.data() + places_of_rows_[inner];
    if (gone) {
      std::fill_n(target, n, kTop);
      continue;
    }
    sources_.clear();
    for_each_row(engine_.grid(), 0, slot.ranges, counter_, [&](std::int64_t first) {
      sources_.push_back(levels_.row(first + static_cast<std::int64_t>(inner)));
    });
    kernels_->minimum(sources_.data(), sources_.size(), target, n);
  }
  for (const Margin& margin : margins_) {
    slot.levels[static_cast<std::size_t>(margin.cell)] =
        margin.source < 0 ? margin.constant : slot.levels[static_cast<std::size_t>(margin.source)];
  }
  erode_from_block(slot);
  for (std::size_t size = 1; size < variants_; ++size) erode(slot, size);
}

/// Each cell becomes the minimum of the smallest box that begins there, a dimension at a time, by doubling.
template <class Level>
void SumReader<Level>::erode_from_block(Slot& slot) {
  Level* block = slot.levels.data();
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const std::int32_t width = widest_[i] - sizes_[i] + 2;
    for (std::int32_t done = 1; done < width;) {
      const std::int32_t step = std::min(done, width - done);
      const Level* pair[] = {block, block + std::int64_t{step} * sides_[i].stride};
      kernels_->minimum(pair, 2, block, static_cast<std::size_t>(block_cells_));
      done += step;
    }
  }
}

/// A box is the union of two that are one index shorter in some dimension; sizes come after all that are
/// smaller.
template <class Level>
void SumReader<Level>::erode(Slot& slot, std::size_t size) {
  std::size_t i = 0;
  while (size / size_stride_[i] % static_cast<std::size_t>(sizes_[i]) == 0) ++i;
  const auto cells = static_cast<std::size_t>(block_cells_);
  const Level* shorter = slot.levels.data() + (size - size_stride_[i]) * cells;
  const Level* pair[] = {shorter, shorter + sides_[i].stride};
  kernels_->minimum(pair, 2, slot.levels.data() + size * cells, cells);
}

template class SumReader<std::uint8_t>;
template class SumReader<std::uint16_t>;
template class SumReader<std::uint32_t>;

}  // namespace coordreq
