#include "safety/row_slices.hpp"

#include <map>
#include <utility>

namespace coordreq {
namespace {

using Kind = RowSegment::Kind;

/// Cuts one row of raw ranges; `entries[c * stride]` is that of cell c, a stride of 0 means the same for all.
class RowCutter {
 public:
  RowCutter(const GridDimension& target, bool is_row_dimension, std::int64_t length)
      : target_(target), is_row_dimension_(is_row_dimension), length_(static_cast<std::int32_t>(length)) {}

  [[nodiscard]] std::vector<RowSegment> cut(const IndexRange* entries, std::int64_t stride) const {
    if (stride == 0) return {fixed(0, length_, entries[0])};
    std::vector<RowSegment> result;
    for (std::int32_t begin = 0; begin < length_;) {
      const RowSegment next = longest_segment(entries, stride, begin);
      append(result, next);
      begin = next.end;
    }
    return result;
  }

 private:
  [[nodiscard]] RowSegment fixed(std::int32_t begin, std::int32_t end, IndexRange raw) const {
    const ResolvedRange r = resolve(raw, target_.count, target_.below, target_.above);
    if (r.blocked) return {begin, end, Kind::blocked, {}};
    if (r.all_left()) return {begin, end, Kind::gone, {}};
    return {begin, end, Kind::fixed, r.inside};
  }

  [[nodiscard]] RowSegment longest_segment(const IndexRange* entries, std::int64_t stride,
                                           std::int32_t begin) const {
    const auto raw = [&](std::int32_t c) { return entries[c * stride]; };
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

}  // namespace

RowSlices cut_into_rows(const Abstraction& abstraction, const TransitionTable& table, std::size_t state,
                        const GridDimension& target) {
  const UniformGrid& grid = abstraction.grid;
  const std::size_t last = grid.size() - 1;
  const std::int64_t length = grid.row_length();
  const std::int64_t column_stride = table.state_stride[last];

  RowSlices result{.ids = {},
                   .slices = {},
                   .state_stride = table.state_stride,
                   .input_stride = table.input_stride,
                   .inputs = table.inputs};
  for (const std::int32_t i : table.inputs) {
    result.input_combinations *= abstraction.inputs[static_cast<std::size_t>(i)].count();
  }
  // Among the states of a table the last dimension is the fastest, so its stride is that of all inputs
  // together.
  const std::int64_t columns = column_stride == 0 ? 1 : length;
  result.state_stride[last] = 0;
  for (std::size_t i = 0; i < last; ++i) result.state_stride[i] /= columns;

  const std::int64_t row_choices =
      static_cast<std::int64_t>(table.entries.size()) / (columns * result.input_combinations);
  const RowCutter cutter(target, state == last, length);
  std::map<std::vector<RowSegment>, std::uint32_t> known;
  result.ids.reserve(static_cast<std::size_t>(row_choices * result.input_combinations));
  for (std::int64_t r = 0; r < row_choices; ++r) {
    for (std::int64_t u = 0; u < result.input_combinations; ++u) {
      const IndexRange* entries = table.entries.data() + r * columns * result.input_combinations + u;
      auto [found, is_new] = known.try_emplace(cutter.cut(entries, column_stride),
                                               static_cast<std::uint32_t>(result.slices.size()));
      if (is_new) result.slices.push_back(found->first);
      result.ids.push_back(found->second);
    }
  }
  return result;
}

}  // namespace coordreq
