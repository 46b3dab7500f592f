#include "engine/box_reader.hpp"

#include <algorithm>
#include <cstring>

#include "base/requires.hpp"
#include "engine/limits.hpp"
#include "engine/row_box.hpp"

namespace coordreq {
namespace {

using Kind = RowSegment::Kind;

constexpr std::int64_t kMostShared = 1024;

/// Wider windows are taken by doubling.
constexpr std::int64_t kNarrowWindow = 6;

/// In shorter rows it takes longer to look for equal rows than to take their minimum.
constexpr std::int64_t kLongRow = 1024;

/// Removes rows that come again, where equal rows are one.
template <class Level>
void leave_different(const LevelRows<Level>& levels, std::vector<const Level*>& rows) {
  if (!levels.is_interned() || levels.row_length() < kLongRow || rows.size() < 2) return;
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
}

}  // namespace

template <class Level>
BoxReader<Level>::BoxReader(const RowEngine& engine, const RowFamily& family, std::size_t outer,
                            const LevelRows<Level>& levels)
    : engine_(engine),
      family_(family),
      outer_(outer),
      levels_(&levels),
      kernels_(&level_kernels<Level>(best_instruction_set())),
      shape_(family.shape) {
  constexpr std::size_t kBlock = kLevelBlock / sizeof(Level);
  lanes_ = static_cast<std::size_t>(levels.row_length()) + kBlock;
  const std::size_t padded = static_cast<std::size_t>(levels.stride()) + kBlock;
  gone_row_.assign(padded, kTop);
  levels.close_row(gone_row_.data() + levels.margins().before);
  wide_.resize(padded);
  result_.resize(lanes_);
  if (outer == 0) return;
  const std::int64_t slot_bytes =
      engine.unit_rows() * levels.stride() * static_cast<std::int64_t>(sizeof(Level));
  slots_.resize(
      static_cast<std::size_t>(std::clamp<std::int64_t>(kSharedBytes / slot_bytes, 2, kMostShared)));
}

template <class Level>
const Level* BoxReader<Level>::minimum(std::span<const std::uint32_t> ids) {
  bool blocked = false;
  bool gone = false;
  if (!is_one_segment(ids, blocked, gone)) {
    read_by_segments(ids);
  } else if (blocked) {
    std::fill(result_.begin(), result_.end(), Level{0});
  } else {
    read_row(ids, gone);
  }
  return result_.data();
}

template <class Level>
const Level* BoxReader<Level>::minimum(const RowBox& box, std::int64_t begin, std::int64_t end) {
  ranges_ = box.ranges;
  windows_ = box.windows;
  read_windows(false, begin, end, result_.data());
  return result_.data();
}

/// Whether every slice is one segment, as is most common. Sets ranges_, and whether the segments are blocked
/// or gone.
template <class Level>
bool BoxReader<Level>::is_one_segment(std::span<const std::uint32_t> ids, bool& blocked, bool& gone) {
  const std::size_t across = engine_.across();
  ranges_.resize(across);
  for (std::size_t t = 0; t < ids.size(); ++t) {
    const std::vector<RowSegment>& slice = family_.slices[t].slices[ids[t]];
    if (slice.size() != 1) return false;
    blocked = blocked || slice[0].kind == Kind::blocked;
    if (t >= across) continue;
    gone = gone || slice[0].kind == Kind::gone;
    ranges_[t] = slice[0].range;
  }
  return true;
}

/// Reads the whole row where every slice is one segment; in rows along several dimensions segments are
/// shifted.
template <class Level>
void BoxReader<Level>::read_row(std::span<const std::uint32_t> ids, bool gone) {
  if (engine_.along() == 1) {
    const std::size_t last = ids.size() - 1;
    read_segment(family_.slices[last].slices[ids[last]][0], gone, 0, levels_->row_length(), result_.data());
    return;
  }
  windows_.clear();
  for (std::size_t t = engine_.across(); t < ids.size(); ++t)
    windows_.push_back(family_.slices[t].slices[ids[t]][0].range);
  read_windows(gone, 0, levels_->row_length(), result_.data());
}

template <class Level>
void BoxReader<Level>::read_by_segments(std::span<const std::uint32_t> ids) {
  const std::size_t last = ids.size() - 1;
  ranges_.resize(last);
  slices_.clear();
  for (std::size_t t = 0; t <= last; ++t) slices_.push_back(&family_.slices[t].slices[ids[t]]);
  positions_.assign(last + 1, 0);
  for (std::int64_t begin = 0; begin < levels_->row_length();) {
    std::int64_t end = levels_->row_length();
    bool blocked = false;
    bool gone = false;
    for (std::size_t t = 0; t <= last; ++t) {
      while ((*slices_[t])[positions_[t]].end <= begin) ++positions_[t];
      const RowSegment& segment = (*slices_[t])[positions_[t]];
      end = std::min<std::int64_t>(end, segment.end);
      blocked = blocked || segment.kind == Kind::blocked;
      gone = gone || (segment.kind == Kind::gone && t != last);
      if (t != last) ranges_[t] = segment.range;
    }
    if (blocked) {
      std::fill(result_.begin() + begin, result_.begin() + end, Level{0});
    } else {
      read_segment((*slices_[last])[positions_[last]], gone, begin, end, wide_.data());
      std::copy(wide_.begin(), wide_.begin() + (end - begin), result_.begin() + begin);
    }
    begin = end;
  }
}

/// Reads the lanes [begin, end), the first of them to out[0].
template <class Level>
void BoxReader<Level>::read_segment(const RowSegment& last, bool gone, std::int64_t begin, std::int64_t end,
                                    Level* out) {
  if (last.kind == Kind::gone) {
    std::fill_n(out, end - begin, kTop);
  } else if (last.kind == Kind::shifted) {
    windows_.assign(1, last.range);
    read_windows(gone, begin, end, out);
  } else {
    read_fixed(last.range, gone, begin, end, out);
  }
}

/// Reads the minimum over all rows of the box and all offsets of the windows.
template <class Level>
void BoxReader<Level>::read_windows(bool gone, std::int64_t begin, std::int64_t end, Level* out) {
  if (is_part_asked_) {
    const std::int64_t asked = std::max(begin, static_cast<std::int64_t>(asked_.begin));
    end = std::min(end, static_cast<std::int64_t>(asked_.end));
    if (asked >= end) return;
    out += asked - begin;
    begin = asked;
  }
  collect_rows(gone);
  const std::size_t along = windows_.size();
  std::int64_t first = begin;
  std::int64_t lanes = end - begin;  // that the windows not yet taken need
  for (std::size_t k = 0; k < along; ++k) {
    first += windows_[k].first * shape_.dimensions[k].stride;
    lanes += (std::int64_t{windows_[k].last} - windows_[k].first) * shape_.dimensions[k].stride;
  }
  sources_.clear();
  for (const Level* row : rows_) sources_.push_back(row + first);
  // One pass a window reads less than all offsets of all windows together.
  for (std::size_t k = 0; k < along; ++k) {
    lanes -= (std::int64_t{windows_[k].last} - windows_[k].first) * shape_.dimensions[k].stride;
    const bool is_last = k + 1 == along;
    // A window of one offset over one row changes nothing: the next pass reads that row.
    if (!is_last && sources_.size() == 1 && windows_[k].first == windows_[k].last) continue;
    take_window(k, static_cast<std::size_t>(lanes), is_last ? out : wide_.data());
    sources_.assign(1, wide_.data());
  }
}

/// The minimum of all sources over one window, which begins at them.
template <class Level>
void BoxReader<Level>::take_window(std::size_t k, std::size_t lanes, Level* out) {
  const std::int64_t stride = shape_.dimensions[k].stride;
  const std::int64_t width = std::int64_t{windows_[k].last} - windows_[k].first + 1;
  if (width <= kNarrowWindow) {
    const std::size_t rows = sources_.size();
    for (std::int64_t s = 1; s < width; ++s) {
      for (std::size_t r = 0; r < rows; ++r) sources_.push_back(sources_[r] + s * stride);
    }
    kernels_->minimum(sources_.data(), sources_.size(), out, lanes);
    return;
  }
  kernels_->minimum(sources_.data(), sources_.size(), wide_.data(),
                    lanes + static_cast<std::size_t>((width - 1) * stride));
  for (std::int64_t done = 1; done < width;) {
    const std::int64_t step = std::min(done, width - done);
    const Level* pair[] = {wide_.data(), wide_.data() + step * stride};
    kernels_->minimum(pair, 2, wide_.data(),
                      lanes + static_cast<std::size_t>((width - done - step) * stride));
    done += step;
  }
  if (out != wide_.data()) std::memmove(out, wide_.data(), lanes * sizeof(Level));  // they may overlap
}

/// All cells go to the same range, which may go on at the other end of a ring.
template <class Level>
void BoxReader<Level>::read_fixed(IndexRange range, bool gone, std::int64_t begin, std::int64_t end,
                                  Level* out) {
  Level least = kTop;
  if (!gone) {
    collect_rows(false);
    const std::int64_t n = levels_->row_length();
    for (const Level* row : rows_) {
      for (std::int64_t c = range.first; c <= range.last; ++c)
        least = std::min(least, row[c < n ? c : c - n]);
    }
  }
  std::fill_n(out, end - begin, least);
}

/// rows_ = the rows of the box, or minima over its leading dimensions.
template <class Level>
void BoxReader<Level>::collect_rows(bool gone) {
  if (gone) {
    rows_.assign(1, gone_row_.data() + levels_->margins().before);
    return;
  }
  if (outer_ == 0) {
    list_rows(engine_.grid(), 0, ranges_, counter_, rows_,
              [&](std::int64_t row) { return levels_->row(row); });
    return leave_different(*levels_, rows_);
  }
  Shared& slot = shared();
  const std::span<const IndexRange> inner(ranges_.data() + outer_, ranges_.size() - outer_);
  list_rows(engine_.grid(), outer_, inner, counter_, rows_,
            [&](std::int64_t row) { return shared_row(slot, row); });
  leave_different(*levels_, rows_);
}

/// The shared minima for the leading ranges of the box.
template <class Level>
typename BoxReader<Level>::Shared& BoxReader<Level>::shared() {
  const auto outer = static_cast<std::ptrdiff_t>(outer_);
  const auto is_wanted = [&](const Shared& slot) {
    return slot.epoch == epoch_ && std::equal(slot.ranges.begin(), slot.ranges.end(), ranges_.begin());
  };
  if (is_wanted(slots_[last_slot_])) return slots_[last_slot_];
  std::uint64_t hash = 0;
  for (auto range = ranges_.begin(); range != ranges_.begin() + outer; ++range) {
    hash = (hash ^ static_cast<std::uint32_t>(range->first)) * 0x9E3779B97F4A7C15U;
    hash = (hash ^ static_cast<std::uint32_t>(range->last)) * 0x9E3779B97F4A7C15U;
  }
  // Two slots are looked at; where both are taken the second is used again.
  last_slot_ = (hash >> 32) % slots_.size();
  if (is_wanted(slots_[last_slot_])) return slots_[last_slot_];
  if (slots_[last_slot_].epoch == epoch_) last_slot_ = (last_slot_ + 1) % slots_.size();
  Shared& slot = slots_[last_slot_];
  if (is_wanted(slot)) return slot;
  slot.epoch = epoch_;
  slot.ranges.assign(ranges_.begin(), ranges_.begin() + outer);
  slot.rows.assign(static_cast<std::size_t>(engine_.unit_rows()), nullptr);
  return slot;
}

template <class Level>
const Level* BoxReader<Level>::shared_row(Shared& shared, std::int64_t inner) {
  const Level*& known = shared.rows[static_cast<std::size_t>(inner)];
  if (known != nullptr) return known;
  list_rows(engine_.grid(), 0, shared.ranges, shared_counter_, sources_,
            [&](std::int64_t first) { return levels_->row(first + inner); });
  leave_different(*levels_, sources_);
  if (sources_.size() == 1) return known = sources_[0];
  // Whole blocks are written, so a row has its last block to itself. Blocks are read from any lane on, so one
  // more follows the last row.
  constexpr auto kBlock = static_cast<std::int64_t>(kLevelBlock / sizeof(Level));
  const std::int64_t stride = (levels_->stride() + kBlock - 1) / kBlock * kBlock;
  if (shared.storage.empty())
    shared.storage.resize(static_cast<std::size_t>(engine_.unit_rows() * stride + kBlock));
  Level* target = shared.storage.data() + inner * stride;
  const std::int64_t before = levels_->margins().before;
  for (const Level*& source : sources_) source -= before;
  const std::int64_t with_margins = before + levels_->row_length() + levels_->margins().after;
  kernels_->minimum(sources_.data(), sources_.size(), target, static_cast<std::size_t>(with_margins));
  return known = target + before;
}

template class BoxReader<std::uint8_t>;
template class BoxReader<std::uint16_t>;
template class BoxReader<std::uint32_t>;
template class BoxReader<std::uint64_t>;

}  // namespace coordreq
