#include "engine/row_slices.hpp"

#include <iterator>
#include <unordered_set>
#include <utility>

#include "base/thread_team.hpp"
#include "model/odometer.hpp"
#include "reach/table_rows.hpp"

namespace coordreq {
namespace {

using Kind = RowSegment::Kind;

/// Cuts one row of raw ranges, given cell by cell, or one range for all cells.
class RowCutter {
 public:
  RowCutter(const GridDimension& target, bool is_row_dimension, std::int64_t length)
      : target_(target), is_row_dimension_(is_row_dimension), length_(static_cast<std::int32_t>(length)) {}

  [[nodiscard]] std::vector<RowSegment> cut(const std::vector<IndexRange>& raw) const {
    if (raw.size() == 1) return {fixed(0, length_, raw[0])};
    std::vector<RowSegment> result;
    for (std::int32_t begin = 0; begin < length_;) {
      const RowSegment next = longest_segment(raw, begin);
      append(result, next);
      begin = next.end;
    }
    return result;
  }

  /// Cuts a row in which cell c goes to c + offset.first, ..., c + offset.last, in constant time.
  [[nodiscard]] RowSegment cut_shift(IndexRange offset) const {
    const RowSegment first = fixed(0, length_, offset);
    if (target_.periodic()) {
      const bool whole_ring = first.range == IndexRange{0, length_ - 1};
      return whole_ring ? first : RowSegment{0, length_, Kind::shifted, first.range};
    }
    const bool all_blocked = (offset.first <= -length_ && traits(target_.below).blocks) ||
                             (offset.last >= length_ && traits(target_.above).blocks);
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

  [[nodiscard]] RowSegment longest_segment(const std::vector<IndexRange>& ranges, std::int32_t begin) const {
    const auto raw = [&](std::int32_t c) { return ranges[static_cast<std::size_t>(c)]; };
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

  /// First and last offset of a range from cell c, in 64 bits: an index that was saturated to 32 bits must
  /// not wrap round. On a ring the first offset is in [0, count).
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

/// Counts through the choices that a table has a slice for: of its states across rows, then of its inputs.
class RowChoices {
 public:
  RowChoices(const Abstraction& abstraction, const TransitionTable& table)
      : table_(table),
        across_(abstraction.grid.across()),
        counter_(counts(abstraction, table)),
        states_(abstraction.grid.size(), 0),
        inputs_(abstraction.inputs.size(), 0) {}

  [[nodiscard]] std::int64_t size() const { return counter_.size(); }

  void seek(std::int64_t number) {
    counter_.seek(number);
    take_indices();
  }
  void advance() {
    counter_.advance();
    take_indices();
  }

  /// Indices of all states and inputs, 0 where not in use.
  [[nodiscard]] const std::vector<std::int64_t>& states() const { return states_; }
  [[nodiscard]] const std::vector<std::int64_t>& inputs() const { return inputs_; }

 private:
  void take_indices() {
    std::size_t v = 0;
    for (const std::int32_t i : table_.states) {
      if (static_cast<std::size_t>(i) < across_)
        states_[static_cast<std::size_t>(i)] = counter_.indices()[v++];
    }
    for (const std::int32_t i : table_.inputs) {
      inputs_[static_cast<std::size_t>(i)] = counter_.indices()[v++];
    }
  }

  static std::vector<std::int64_t> counts(const Abstraction& abstraction, const TransitionTable& table) {
    std::vector<std::int64_t> result;
    for (const std::int32_t i : table.states) {
      if (static_cast<std::size_t>(i) < abstraction.grid.across())
        result.push_back(abstraction.grid[static_cast<std::size_t>(i)].count);
    }
    for (const std::int32_t i : table.inputs) {
      result.push_back(abstraction.inputs[static_cast<std::size_t>(i)].count());
    }
    return result;
  }

  const TransitionTable& table_;
  std::size_t across_;
  Odometer counter_;
  std::vector<std::int64_t> states_;
  std::vector<std::int64_t> inputs_;
};

/// Interns slices: numbers them in the order in which they first come.
class SliceNumbers {
 public:
  /// @pre unchecked: `slices` outlives this object.
  explicit SliceNumbers(std::vector<std::vector<RowSegment>>& slices)
      : slices_(slices), known_(0, Hash{&slices}, Equal{&slices}) {}

  std::uint32_t number(std::vector<RowSegment> slice) {
    slices_.push_back(std::move(slice));
    const auto [found, is_new] = known_.insert(static_cast<std::uint32_t>(slices_.size() - 1));
    if (!is_new) slices_.pop_back();
    return *found;
  }

 private:
  struct Hash {
    const std::vector<std::vector<RowSegment>>* slices;
    std::size_t operator()(std::uint32_t i) const {
      std::uint64_t sum = 0;
      for (const RowSegment& s : (*slices)[i]) {
        for (const std::int64_t number : {std::int64_t{s.begin} << 8U | static_cast<std::int64_t>(s.kind),
                                          std::int64_t{s.range.first}, std::int64_t{s.range.last}}) {
          sum = (sum ^ static_cast<std::uint64_t>(number)) * 0x9E3779B97F4A7C15U;
          sum ^= sum >> 29U;
        }
      }
      return sum;
    }
  };
  struct Equal {
    const std::vector<std::vector<RowSegment>>* slices;
    bool operator()(std::uint32_t i, std::uint32_t j) const { return (*slices)[i] == (*slices)[j]; }
  };

  std::vector<std::vector<RowSegment>>& slices_;
  std::unordered_set<std::uint32_t, Hash, Equal> known_;
};

/// The choices that belong to rows held.
ThreadTeam::Range held_choices(const UniformGrid& grid, const TransitionTable& table, std::int64_t all) {
  if (!table.is_by_cells(grid.size())) return {0, all};
  const std::int64_t row = grid.row_length();
  return {table.before / row, (table.before + std::ssize(table.entries)) / row};
}

/// Sets the strides into `ids`, row-major over the choices that RowChoices counts.
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
    if (j >= grid.across()) continue;
    slices.state_stride[j] = stride;
    stride *= grid[j].count;
  }
}

}  // namespace

RowSlices keep_as_sums(const Abstraction& abstraction, const TransitionTable& table, SumRows sums) {
  RowSlices result{.inputs = table.inputs};
  lay_out_ids(result, abstraction.grid, abstraction.inputs, table);
  result.sums = std::move(sums);
  return result;
}

RowSlices cut_into_rows(const Abstraction& abstraction, const TransitionTable& table, std::size_t state,
                        const GridDimension& target) {
  const UniformGrid& grid = abstraction.grid;
  // Where rows run along several dimensions, each of these moves by offsets of its own.
  const std::size_t along = state < grid.across() ? grid.size() - 1 : state;
  RowSlices result{.ids = {}, .slices = {}, .state_stride = {}, .input_stride = {}, .inputs = table.inputs};
  lay_out_ids(result, grid, abstraction.inputs, table);
  const RowCutter cutter(target, state == along, grid[along].count);
  SliceNumbers numbers(result.slices);
  const TableRows rows(table, state, along);
  const bool one_range = rows.is_constant() || rows.is_shift();
  std::vector<IndexRange> row(one_range ? 1 : static_cast<std::size_t>(grid[along].count));
  std::vector<IndexRange> before;
  RowChoices choice(abstraction, table);
  const ThreadTeam::Range held = held_choices(grid, table, choice.size());
  result.before = held.begin;
  result.ids.reserve(static_cast<std::size_t>(held.end - held.begin));
  choice.seek(held.begin);
  for (std::int64_t i = held.begin; i < held.end; ++i, choice.advance()) {
    rows.read(choice.states(), choice.inputs(), row);
    if (row == before) {  // neighbouring inputs often have equal rows
      result.ids.push_back(result.ids.back());
      continue;
    }
    result.ids.push_back(
        numbers.number(rows.is_shift() ? std::vector{cutter.cut_shift(row[0])} : cutter.cut(row)));
    before.swap(row);
    row.resize(before.size());
  }
  return result;
}

}  // namespace coordreq
