#include "safety/row_engine.hpp"

#include <algorithm>

namespace coordreq {

using Kind = RowSegment::Kind;

RowEngine::RowEngine(const Abstraction& abstraction, const ConditionTable* allow, const SafeTubes& tubes,
                     ThreadTeam& team)
    : abstraction_(&abstraction), allow_(allow) {
  std::vector<GridDimension> dimensions = abstraction.grid.dimensions();
  for (std::size_t i = 0; i < dimensions.size(); ++i) {
    row_stride_.push_back(abstraction.grid.stride(i) / abstraction.grid.row_length());
    count_.push_back(dimensions[i].count);
  }
  cut(abstraction.tables, dimensions);
  if (tubes.inside == nullptr) return;
  const auto demand = [&](const CellSet& set) {
    cut(abstraction.tubes, dimensions);
    tube_targets_.emplace_back(set, slices_.back(), dimensions.back(), team);
  };
  demand(tubes.beyond != nullptr ? *tubes.beyond : *tubes.inside);
  if (tubes.beyond == nullptr) return;
  // The same tubes again, now blocked where they pass a limit: what is left need not be safe beyond it.
  for (GridDimension& dimension : dimensions) {
    if (dimension.below == Outside::saturate) dimension.below = Outside::unsafe;
    if (dimension.above == Outside::saturate) dimension.above = Outside::unsafe;
  }
  demand(*tubes.inside);
}

void RowEngine::cut(const std::vector<TransitionTable>& tables, const std::vector<GridDimension>& targets) {
  for (std::size_t i = 0; i < tables.size(); ++i) {
    slices_.push_back(cut_into_rows(*abstraction_, tables[i], i, targets[i]));
  }
  ends_.push_back({targets.back().below, targets.back().above});
}

RowEngine::Family RowEngine::family(std::size_t number) const {
  return {std::span(slices_).subspan(number * tables(), tables()), ends_[number]};
}

std::int64_t RowEngine::base(std::int64_t row, std::size_t table) const {
  const UniformGrid& grid = abstraction_->grid;
  std::int64_t result = 0;
  for (std::size_t i = 0; i + 1 < grid.size(); ++i) {
    const std::int64_t stride = slices_[table].state_stride[i];
    if (stride != 0) result += grid.index(row * grid.row_length(), i) * stride;
  }
  return result;
}

/// The common case: every slice is one segment and the erosion is at hand. @returns false if it is not that
/// case
bool RowEngine::inside_simple(std::span<const RowSlices> slices, std::span<const std::uint32_t> ids,
                              const RowTarget& target, MutableRow out, Scratch& scratch) const {
  const std::size_t last = slices.size() - 1;
  const CellSet* eroded = target.eroded(ids[last]);
  if (eroded == nullptr) return false;
  scratch.box.resize(last);
  bool blocked = false;
  for (std::size_t t = 0; t < last; ++t) {
    const std::vector<RowSegment>& slice = slices[t].slices[ids[t]];
    if (slice.size() != 1 || slice[0].kind == Kind::gone) return false;
    blocked = blocked || slice[0].kind == Kind::blocked;
    scratch.box[t] = slice[0].range;
  }
  if (blocked) {
    std::fill(out.begin(), out.end(), Word{0});
  } else {
    gather(*eroded, scratch.indices, scratch.box, out);
  }
  return true;
}

void RowEngine::inside(std::span<const std::uint32_t> ids, const RowTarget& target, MutableRow out,
                       Scratch& scratch) const {
  boxes_inside(family(0), ids.first(tables()), target, out, scratch);
  if (!tube_targets_.empty() && any_set(out)) clear_unsafe_tubes(ids, out, scratch);
}

void RowEngine::clear_unsafe_tubes(std::span<const std::uint32_t> ids, MutableRow out,
                                   Scratch& scratch) const {
  scratch.tube.resize(out.size());
  scratch.safe_tubes.assign(out.size(), 0);
  for (std::size_t f = 0; f < tube_targets_.size(); ++f) {
    const auto own_ids = ids.subspan((f + 1) * tables(), tables());
    boxes_inside(family(f + 1), own_ids, tube_targets_[f], scratch.tube, scratch);
    for (std::size_t w = 0; w < out.size(); ++w) scratch.safe_tubes[w] |= scratch.tube[w];
  }
  for (std::size_t w = 0; w < out.size(); ++w) out[w] &= scratch.safe_tubes[w];
}

/// out = {x in the row : the box of what the slices say is not blocked and inside `target`}.
void RowEngine::boxes_inside(const Family& family, std::span<const std::uint32_t> ids,
                             const RowTarget& target, MutableRow out, Scratch& scratch) const {
  const std::span<const RowSlices> slices = family.slices;
  if (inside_simple(slices, ids, target, out, scratch)) return;
  const std::size_t tables = slices.size();
  const std::size_t last = tables - 1;
  scratch.slices.resize(tables);
  scratch.positions.assign(tables, 0);
  scratch.box.resize(last);
  for (std::size_t t = 0; t < tables; ++t) scratch.slices[t] = &slices[t].slices[ids[t]];
  std::fill(out.begin(), out.end(), Word{0});

  const auto length = static_cast<std::int32_t>(row_length());
  for (std::int32_t begin = 0; begin < length;) {
    std::int32_t end = length;
    bool blocked = false;
    bool gone = false;
    for (std::size_t t = 0; t < tables; ++t) {
      while ((*scratch.slices[t])[scratch.positions[t]].end <= begin) ++scratch.positions[t];
      const RowSegment& segment = (*scratch.slices[t])[scratch.positions[t]];
      end = std::min(end, segment.end);
      blocked = blocked || segment.kind == Kind::blocked;
      gone = gone || (segment.kind == Kind::gone && t != last);
      if (t != last) scratch.box[t] = segment.range;
    }
    if (!blocked) {
      if (gone) {
        // Nothing is left inside in one dimension, so any target will do; the last dimension may still block.
        scratch.gathered.assign(out.size(), ~Word{0});
        if (length % CellSet::kWordBits != 0)
          scratch.gathered.back() = (Word{1} << (length % CellSet::kWordBits)) - 1;
      } else {
        scratch.gathered.resize(out.size());
        gather(target.set(), scratch.indices, scratch.box, scratch.gathered);
      }
      place_segment((*scratch.slices[last])[scratch.positions[last]], family.ends, begin, end, scratch, out);
    }
    begin = end;
  }
}

/// out = AND of the rows of `target` in the box. On a ring indices beyond its last cell begin anew.
void RowEngine::gather(const CellSet& target, std::vector<std::int64_t>& indices,
                       const std::vector<IndexRange>& box, MutableRow out) const {
  indices.resize(box.size());
  std::int64_t row = 0;
  for (std::size_t i = 0; i < box.size(); ++i) {
    indices[i] = box[i].first;
    row += indices[i] * row_stride_[i];
  }
  const ConstRow first = target.row(row);
  std::copy(first.begin(), first.end(), out.begin());
  for (;;) {
    std::size_t i = box.size();
    for (;;) {
      if (i == 0) return;
      --i;
      if (++indices[i] <= box[i].last) {
        row += row_stride_[i];
        if (indices[i] == count_[i]) row -= count_[i] * row_stride_[i];
        break;
      }
      const std::int64_t last = box[i].last < count_[i] ? box[i].last : box[i].last - count_[i];
      row -= (last - box[i].first) * row_stride_[i];
      indices[i] = box[i].first;
    }
    const ConstRow source = target.row(row);
    Word left = 0;
    for (std::size_t w = 0; w < source.size(); ++w) left |= (out[w] &= source[w]);
    if (left == 0) return;
  }
}

/// True if the row holds all cells of the range, which may go on at the other end of a ring.
bool RowEngine::holds(ConstRow row, IndexRange range) const {
  const std::int64_t end = std::int64_t{range.last} + 1;
  return all_set(row, range.first, std::min(end, row_length())) && all_set(row, 0, end - row_length());
}

void RowEngine::place_segment(const RowSegment& last, const RowEnds& ends, std::int32_t begin,
                              std::int32_t end, Scratch& scratch, MutableRow out) const {
  if (last.kind != Kind::shifted) {
    if (last.kind == Kind::gone || holds(scratch.gathered, last.range)) set_bits(out, begin, end);
    return;
  }
  scratch.eroded.assign(out.size(), 0);
  scratch.eroder.erode(scratch.gathered, row_length(), last.range.first, last.range.last, ends,
                       scratch.eroded);
  if (begin == 0 && end == row_length()) {
    for (std::size_t w = 0; w < out.size(); ++w) out[w] |= scratch.eroded[w];
    return;
  }
  const std::size_t first_word = static_cast<std::size_t>(begin / CellSet::kWordBits);
  const std::size_t last_word = static_cast<std::size_t>((end - 1) / CellSet::kWordBits);
  for (std::size_t w = first_word; w <= last_word; ++w) {
    const std::int64_t low = std::max<std::int64_t>(begin - static_cast<std::int64_t>(w) * 64, 0);
    const std::int64_t high = std::min<std::int64_t>(end - static_cast<std::int64_t>(w) * 64, 64);
    const Word mask = (high == 64 ? ~Word{0} : (Word{1} << high) - 1) & (~Word{0} << low);
    out[w] |= scratch.eroded[w] & mask;
  }
}

}  // namespace coordreq
