#include "engine/sum_patches.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <utility>

#include "base/requires.hpp"
#include "engine/limits.hpp"
#include "engine/row_box.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kMostPatches = 1024;

/// Joined boxes are of one size.
template <class Key>
bool is_joined(const Key& key) {
  return !key.widths.empty();
}

}  // namespace

PatchLayout::PatchLayout(const RowEngine& engine, std::size_t level_bytes) {
  REQUIRES(!engine.posts().is_cut());
  const std::size_t outer = engine.outer();
  sides.resize(engine.tables() - outer);
  std::int64_t stride = 1, beyond = 0;
  for (std::size_t i = sides.size(); i-- > 0;) {
    Side& side = sides[i];
    const IndexRange widths = engine.posts().slices[outer + i].sums->widths();
    side.count = static_cast<std::int32_t>(engine.grid()[outer + i].count);
    side.narrowest = widths.first;
    side.reach = widths.last + most_wider(side.count);
    side.sizes = widths.last - widths.first + 1;
    side.size_stride = sizes;
    sizes *= static_cast<std::size_t>(side.sizes);
    side.stride = static_cast<std::int32_t>(stride);
    origin += (side.reach + 1) * side.stride;
    beyond += std::int64_t{side.reach + 1} * side.stride;
    stride *= side.count + 2 * (side.reach + 1);
  }
  // Kernels write whole blocks of levels: the next size begins after the last of them.
  const auto block = static_cast<std::int64_t>(kLevelBlock / level_bytes);
  cells = (stride + block - 1) / block * block;
  room_beyond = static_cast<std::size_t>(beyond) + kLevelBlock;
  first_offset = origin;
  for (const Side& side : sides)
    first_offset -=
        side.narrowest * static_cast<std::int32_t>(static_cast<std::int64_t>(side.size_stride) * cells);
}

template <class Level>
struct SumPatches<Level>::Unit {
  struct Patch {
    std::once_flag once;
    std::atomic<bool> is_made = false;
    std::vector<Level> levels;
  };
  std::int64_t number;
  const LevelRows<Level>* levels;
  std::map<Key, Patch> patches;
  std::array<std::size_t, 2> count{};  ///< of them, of all sizes and of one
};

template <class Level>
SumPatches<Level>::SumPatches(const RowEngine& engine)
    : engine_(engine),
      layout_(engine, sizeof(Level)),
      kernels_(&level_kernels<Level>(best_instruction_set())) {
  find_margins();
  for (const PatchLayout::Side& side : layout_.sides) narrowest_.push_back(side.narrowest);
  const auto cells = static_cast<std::size_t>(layout_.cells);
  most_ = {std::clamp<std::size_t>(kPatchBytes / (layout_.sizes * cells * sizeof(Level)), 2, kMostPatches),
           kJoinedPatches};
  room_ = {layout_.sizes * cells + layout_.room_beyond, cells + layout_.room_beyond};
}

template <class Level>
SumPatches<Level>::~SumPatches() = default;

template <class Level>
void SumPatches<Level>::find_margins() {
  const std::vector<PatchLayout::Side>& sides = layout_.sides;
  std::vector<std::int32_t> index(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) index[i] = -(sides[i].reach + 1);
  for (std::int32_t cell = 0;; ++cell) {
    bool outside = false;
    bool unsafe = false;
    bool safe = false;
    std::int32_t nearest = layout_.origin;
    bool row_start = index.back() == 0;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const GridDimension& dimension = engine_.grid()[engine_.outer() + i];
      const std::int32_t inside = std::clamp(index[i], 0, sides[i].count - 1);
      nearest += inside * sides[i].stride;
      if (inside == index[i]) continue;
      const OutsideTraits& rule = traits(index[i] < 0 ? dimension.below : dimension.above);
      outside = true;
      row_start = false;
      unsafe = unsafe || rule.blocks;
      safe = safe || rule.arrives;
    }
    if (row_start) row_offsets_.push_back(cell);
    // A cell beyond an unsafe side is blocked, wherever else it lies; else a cell beyond a safe side is gone.
    if (outside) add_margin({cell, 1, unsafe || safe ? -1 : nearest, 0, unsafe ? Level{0} : kTop});
    std::size_t i = sides.size();
    while (i-- > 0) {
      if (++index[i] < sides[i].count + sides[i].reach + 1) break;
      if (i == 0) return;
      index[i] = -(sides[i].reach + 1);
    }
  }
}

/// Adds a cell to the last run of cells, if it goes on there.
template <class Level>
void SumPatches<Level>::add_margin(const Margin& margin) {
  if (!margins_.empty() && margins_.back().cell + margins_.back().count == margin.cell) {
    Margin& last = margins_.back();
    const bool is_constant = margin.source < 0;
    if (is_constant && last.source < 0 && last.constant == margin.constant) {
      ++last.count;
      return;
    }
    const std::int32_t step = margin.source - last.source;
    if (!is_constant && last.source >= 0 && last.count == 1 && (step == 0 || step == 1)) last.step = step;
    if (!is_constant && last.source >= 0 && margin.source == last.source + last.count * last.step) {
      ++last.count;
      return;
    }
  }
  margins_.push_back(margin);
}

template <class Level>
void SumPatches<Level>::enter(std::int64_t unit, const LevelRows<Level>& levels,
                              std::shared_ptr<Unit>& held) {
  const std::lock_guard lock(mutex_);
  held.reset();
  std::erase_if(units_, [&](const std::shared_ptr<Unit>& one) {
    if (one->number == unit && one->levels == &levels) held = one;
    if (one.use_count() > 1) return false;
    give_up(*one);
    return true;
  });
  if (held != nullptr) return;
  held = std::make_shared<Unit>();
  held->number = unit;
  held->levels = &levels;
  units_.push_back(held);
}

template <class Level>
void SumPatches<Level>::forget() {
  const std::lock_guard lock(mutex_);
  for (const std::shared_ptr<Unit>& unit : units_) give_up(*unit);
  units_.clear();
}

template <class Level>
void SumPatches<Level>::give_up(Unit& unit) {
  for (auto& [key, patch] : unit.patches) spare_[is_joined(key) ? 1 : 0].push_back(std::move(patch.levels));
  unit.patches.clear();
}

template <class Level>
const Level* SumPatches<Level>::find(Unit& unit, const Key& key, ShortWait& wait) {
  typename Unit::Patch* patch = nullptr;
  bool is_new = false;
  {
    const std::lock_guard lock(mutex_);
    const auto found = unit.patches.find(key);
    is_new = found == unit.patches.end();
    if (is_new) {
      const std::size_t kind = is_joined(key) ? 1 : 0;
      if (unit.count[kind] == most_[kind]) return nullptr;
      ++unit.count[kind];
      patch = &unit.patches[key];
      if (spare_[kind].empty()) spare_[kind].emplace_back(room_[kind]);
      patch->levels = std::move(spare_[kind].back());
      spare_[kind].pop_back();
    } else {
      patch = &found->second;
    }
  }
  const auto is_made = [patch] { return patch->is_made.load(std::memory_order_acquire); };
  if (!is_new && wait.comes_soon(is_made)) return patch->levels.data();
  // If the thread that began to make it has failed, this one makes it.
  std::call_once(patch->once, [&] {
    fill(unit, key, patch->levels.data());
    patch->is_made.store(true, std::memory_order_release);
  });
  return patch->levels.data();
}

template <class Level>
void SumPatches<Level>::make(const Unit& unit, const Key& key, std::vector<Level>& levels) const {
  levels.resize(room_[is_joined(key) ? 1 : 0]);
  fill(unit, key, levels.data());
}

/// Fills a patch with the minima over the leading dimensions, and its margins; and erodes it.
template <class Level>
void SumPatches<Level>::fill(const Unit& unit, const Key& key, Level* patch) const {
  const auto n = static_cast<std::size_t>(engine_.row_length());
  const bool is_gone = key.ranges[0].first > key.ranges[0].last;
  std::vector<std::int64_t> counter;
  std::vector<const Level*> sources;
  for (std::size_t inner = 0; inner < row_offsets_.size(); ++inner) {
    Level* const target = patch + row_offsets_[inner];
    if (is_gone) {
      std::fill_n(target, n, kTop);
      continue;
    }
    list_rows(engine_.grid(), 0, key.ranges, counter, sources,
              [&](std::int64_t first) { return unit.levels->row(first + static_cast<std::int64_t>(inner)); });
    kernels_->minimum(sources.data(), sources.size(), target, n);
  }
  for (const Margin& margin : margins_) {
    Level* const target = patch + margin.cell;
    if (margin.step == 1) {
      std::copy_n(patch + margin.source, margin.count, target);
    } else {
      std::fill_n(target, margin.count, margin.source < 0 ? margin.constant : patch[margin.source]);
    }
  }
  erode_in_place(is_joined(key) ? key.widths : narrowest_, patch);
  for (std::size_t size = 1; size < (is_joined(key) ? 1 : layout_.sizes); ++size) erode(size, patch);
}

/// Each cell of the first patch becomes the minimum of the box that begins there: one dimension at a time, by
/// doubling. Reads beyond the patch, where levels make no difference.
template <class Level>
void SumPatches<Level>::erode_in_place(const std::vector<std::int32_t>& widths, Level* patch) const {
  for (std::size_t i = 0; i < layout_.sides.size(); ++i) {
    for (std::int32_t done = 1; done < widths[i] + 1;) {
      const std::int32_t step = std::min(done, widths[i] + 1 - done);
      const Level* pair[] = {patch, patch + std::int64_t{step} * layout_.sides[i].stride};
      kernels_->minimum(pair, 2, patch, static_cast<std::size_t>(layout_.cells));
      done += step;
    }
  }
}

/// Makes the patch of a size from that of a smaller one: a box is the union of two that are one index shorter
/// in some dimension.
template <class Level>
void SumPatches<Level>::erode(std::size_t size, Level* patches) const {
  const PatchLayout::Side* side = layout_.sides.data();
  while (size / side->size_stride % static_cast<std::size_t>(side->sizes) == 0) ++side;
  const auto cells = static_cast<std::size_t>(layout_.cells);
  const Level* const shorter = patches + (size - side->size_stride) * cells;
  const Level* pair[] = {shorter, shorter + side->stride};
  kernels_->minimum(pair, 2, patches + size * cells, cells);
}

template class SumPatches<std::uint8_t>;
template class SumPatches<std::uint16_t>;
template class SumPatches<std::uint32_t>;
template class SumPatches<std::uint64_t>;

}  // namespace coordreq
