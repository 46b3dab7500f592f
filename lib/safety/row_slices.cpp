#include "safety/row_slices.hpp"

#include <map>
#include <utility>

#include "abstraction/counter.hpp"

namespace coordreq {
namespace {

using Kind = RowSegment::Kind;

/// Cuts one row of raw ranges; `raw(c)` is that of cell c.
class RowCutter {
 public:
  RowCutter(const GridDimension& target, bool is_row_dimension, std::int64_t length)
      : target_(target), is_row_dimension_(is_row_dimension), length_(static_cast<std::int32_t>(length)) {}

  template <class Raw>
  [[nodiscard]] std::vector<RowSegment> cut(const Raw& raw, bool all_alike) const {
    if (all_alike) return {fixed(0, length_, raw(0))};
    std::vector<RowSegment> result;
    for (std::int32_t begin = 0; begin < length_;) {
      const RowSegment next = longest_segment(raw, begin);
      append(result, next);
      begin = next.end;
    }
    return result;
  }

  /// The row along which cell c goes to c + offset.first, ..., c + offset.last, without a look at its cells.
  [[nodiscard]] RowSegment cut_shift(IndexRange offset) const {
    const RowSegment first = fixed(0, length_, offset);
    if (target_.periodic()) {
      const bool whole_ring = first.range == IndexRange{0, length_ - 1};
      return whole_ring ? first : RowSegment{0, length_, Kind::shifted, first.range};
    }
    const bool all_blocked = (offset.first <= -length_ && target_.below == Outside::unsafe) ||
                             (offset.last >= length_ && target_.above == Outside::unsafe);
    if (all_blocked) return {0, length_, Kind::blocked, {}};
    const bool all_leave = offset.first >= length_ || offset.last <= -length_;
    return length_ == 1 || all_leave ? first : RowSegment{0, length_, Kind::shifted, offset};
  }

 private:
  [[nodiscard]] RowSegment fixed(std::int32_t begin, std::int32_t end, IndexRange raw) const {
    const ResolvedRange r = resolve(raw, target_.count, target_.below, target_.above);
    if (r.blocked) return {begin, end, Kind::blocked, {}};
    if (r.all_left()) return {begin, end, Kind::gone, {}};
    return {begin, end, Kind::fixed, r.inside};
  }

  template <class Raw>
  [[nodiscard]] RowSegment longest_segment(const Raw& raw, std::int32_t begin) const {
    RowSegment segment = fixed(begin, begin + 1, raw(begin));
    while (segment.end < length_) {
      RowSegment next = fixed(begin, segment.end + 1, raw(segment.end));
      if (next.kind != segment.kind || next.range != segment.range) break;
      segment.end = next.end;
    }
    if (!is_row_dimension_) return segment;
    std::int32_t end = begin + 1;
    while (end < length_ && offset(raw(end), end) == offset(raw(begin), begin)) ++end;
    if (end <= segment.end) return segment;
    const auto [low, high] = offset(raw(begin), begin);
    return {begin, end, Kind::shifted, {saturate_index(low), saturate_index(high)}};
  }

  /// Where the range lies relative to cell c, in 64 bits: an index that was saturated to 32 must not wrap
  /// round here. On a ring the first one is in [0, count).
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> offset(IndexRange raw, std::int32_t c) const {
    if (!target_.periodic()) {
      return {static_cast<std::int64_t>(raw.first) - c, static_cast<std::int64_t>(raw.last) - c};
    }
    const IndexRange range = wrap_range(raw, target_.count);
    const std::int64_t ahead = std::int64_t{range.first} - c;
    const std::int64_t low = ahead < 0 ? ahead + target_.count : ahead;
    return {low, low + range.last - range.first};
  }

  static void append(std::vector<RowSegment>& segments, const RowSegment& next) {
    if (!segments.empty() && segments.back().kind == next.kind && segments.back().range == next.range) {
      segments.back().end = next.end;
    } else {
      segments.push_back(next);
    }
  }

  const GridDimension& target_;
  bool is_row_dimension_;
  std::int32_t length_;
};

/// Counts through what the slices of one table range over: its states without the last one, then its inputs.
class RowChoices {
 public:
  RowChoices(const Abstraction& abstraction, const TransitionTable& table, std::size_t state)
      : counter_(counts(abstraction, table)) {
    const std::size_t last = abstraction.grid.size() - 1;
    for (const std::int32_t i : table.states) {
      const auto s = static_cast<std::size_t>(i);
      if (s == last) continue;
      if (s == state) own_ = static_cast<std::int32_t>(strides_.size());
      strides_.push_back(table.state_stride[s]);
    }
    for (const std::int32_t i : table.inputs)
      strides_.push_back(table.input_stride[static_cast<std::size_t>(i)]);
  }

  [[nodiscard]] std::int64_t size() const { return counter_.size(); }
  bool next() { return counter_.next(); }

  /// Of the entry of the row's first cell.
  [[nodiscard]] std::int64_t position() const {
    std::int64_t sum = 0;
    for (std::size_t v = 0; v < strides_.size(); ++v) sum += counter_.indices()[v] * strides_[v];
    return sum;
  }

  /// Index of the table's own state; 0 if that is the last one or not in use.
  [[nodiscard]] std::int64_t own() const {
    return own_ < 0 ? 0 : counter_.indices()[static_cast<std::size_t>(own_)];
  }

 private:
  static std::vector<std::int64_t> counts(const Abstraction& abstraction, const TransitionTable& table) {
    const std::size_t last = abstraction.grid.size() - 1;
    std::vector<std::int64_t> result;
    for (const std::int32_t i : table.states) {
      if (static_cast<std::size_t>(i) != last)
        result.push_back(abstraction.grid[static_cast<std::size_t>(i)].count);
    }
    for (const std::int32_t i : table.inputs) {
      result.push_back(abstraction.inputs[static_cast<std::size_t>(i)].count());
    }
    return result;
  }

  Counter counter_;
  std::vector<std::int64_t> strides_;
  std::int32_t own_ = -1;
};

/// Strides into `ids`, over what RowChoices counts.
void lay_out_ids(RowSlices& slices, const UniformGrid& grid, const InputSpace& inputs,
                 const TransitionTable& table) {
  slices.state_stride.assign(grid.size(), 0);
  slices.input_stride.assign(inputs.size(), 0);
  std::int64_t stride = 1;
  for (auto it = table.inputs.rbegin(); it != table.inputs.rend(); ++it) {
    const auto j = static_cast<std::size_t>(*it);
    slices.input_stride[j] = stride;
    stride *= inputs[j].count();
  }
  slices.input_combinations = stride;
  for (auto it = table.states.rbegin(); it != table.states.rend(); ++it) {
    const auto j = static_cast<std::size_t>(*it);
    if (j + 1 == grid.size()) continue;
    slices.state_stride[j] = stride;
    stride *= grid[j].count;
  }
}

}  // namespace

RowSlices cut_into_rows(const Abstraction& abstraction, const TransitionTable& table, std::size_t state,
                        const GridDimension& target) {
  const UniformGrid& grid = abstraction.grid;
  const std::size_t last = grid.size() - 1;
  const std::int64_t column_stride = table.state_stride[last];

  RowSlices result{.ids = {}, .slices = {}, .state_stride = {}, .input_stride = {}, .inputs = table.inputs};
  lay_out_ids(result, grid, abstraction.inputs, table);
  const RowCutter cutter(target, state == last, grid.row_length());
  std::map<std::vector<RowSegment>, std::uint32_t> known;
  RowChoices choice(abstraction, table, state);
  result.ids.reserve(static_cast<std::size_t>(choice.size()));
  do {
    const std::int64_t position = choice.position();
    const auto slice =
        table.shift && state == last
            ? std::vector{cutter.cut_shift(table.range(position, 0))}
            : cutter.cut(
                  [&](std::int32_t c) { return table.range(position + c * column_stride, choice.own()); },
                  column_stride == 0);
    auto [found, is_new] = known.try_emplace(slice, static_cast<std::uint32_t>(result.slices.size()));
    if (is_new) result.slices.push_back(found->first);
    result.ids.push_back(found->second);
  } while (choice.next());
  return result;
}

}  // namespace coordreq
