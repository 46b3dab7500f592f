#include <algorithm>

#include "engine/row_slices.hpp"
#include "model/pieces.hpp"

namespace coordreq {
namespace {

using Kind = RowSegment::Kind;

constexpr IndexRange kNone{0, -1};

bool range_within(IndexRange a, IndexRange b, const GridDimension& target) {
  const auto inside = [&](std::int64_t shift) {
    return b.first <= a.first + shift && a.last + shift <= b.last;
  };
  if (inside(0)) return true;
  return target.periodic() && (inside(target.count) || std::int64_t{b.last} - b.first + 1 == target.count);
}

/// The range; on a ring with its first index in [0, count).
IndexRange normal(IndexRange range, const GridDimension& target) {
  if (!target.periodic()) return range;
  const auto n = static_cast<std::int32_t>(target.count);
  const std::int32_t first = (range.first % n + n) % n;
  return {first, first + (range.last - range.first)};
}

/// The hull of slices that are lists of segments.
IndexRange hull_of_segments(const RowSlices& slices, std::int64_t base, const GridDimension& target,
                            const RowDimension* along) {
  const Kind expected = along != nullptr ? Kind::shifted : Kind::fixed;
  IndexRange result = kNone;
  std::uint32_t previous = UINT32_MAX;
  for (std::int64_t position = base; position < base + slices.input_combinations; ++position) {
    const std::uint32_t id = slices.number(position);
    if (id == previous) continue;
    previous = id;
    for (const RowSegment& segment : slices.slices[id]) {
      if (segment.kind != expected) continue;
      const IndexRange range = normal(segment.range, target);
      result = result == kNone ? range : merge_ranges(result, range, target);
    }
  }
  if (result == kNone) return result;
  if (along != nullptr) return fit_window(result, target.count, along->ends);
  return target.periodic() ? wrap_range(result, target.count) : result;
}

/// The hull of sums, by the bounds of their profiles; the state of a sum does not wrap round.
IndexRange hull_of_sums(const RowSlices& slices, std::int64_t base, SumRows::Reader& reader,
                        const GridDimension& target, const RowDimension* along) {
  IndexRange raw{INT32_MAX, INT32_MIN};
  for (std::int64_t position = base; position < base + slices.input_combinations; ++position) {
    const SumRows::Row row = reader.row(slices.number(position));
    const IndexRange range = along != nullptr ? slices.sums->offset_hull(row) : slices.sums->hull(row);
    raw = {std::min(raw.first, range.first), std::max(raw.last, range.last)};
  }
  if (along != nullptr) return fit_window(raw, target.count, along->ends);
  const auto last = static_cast<std::int32_t>(target.count - 1);
  return {std::clamp(raw.first, 0, last), std::clamp(raw.last, 0, last)};
}

}  // namespace

bool RowSlices::is_within(std::uint32_t a, std::uint32_t b, const GridDimension& target) const {
  if (a == b) return true;
  if (!is_cut()) return false;
  const std::vector<RowSegment>& one = slices[a];
  const std::vector<RowSegment>& other = slices[b];
  if (one.size() != 1 || other.size() != 1) return one == other;
  if (one[0].kind == Kind::gone || other[0].kind == Kind::blocked) return true;
  return one[0].kind == other[0].kind && range_within(one[0].range, other[0].range, target);
}

std::vector<IndexRange> slice_hulls(const RowSlices& slices, const GridDimension& target,
                                    const RowDimension* along, ThreadTeam* team) {
  constexpr std::int64_t kSlicesAtOnce = 1 << 14;
  const std::int64_t inputs = slices.input_combinations, bases = (slices.size() + inputs - 1) / inputs;
  std::vector<IndexRange> hulls(static_cast<std::size_t>(bases));
  for_each(team, bases, kSlicesAtOnce / inputs, [&](ThreadTeam::Range range, int) {
    std::optional<SumRows::Reader> reader;
    if (slices.sums) reader.emplace(*slices.sums);
    for (std::int64_t k = range.begin; k < range.end; ++k) {
      hulls[static_cast<std::size_t>(k)] = reader ? hull_of_sums(slices, k * inputs, *reader, target, along)
                                                  : hull_of_segments(slices, k * inputs, target, along);
    }
  });
  return hulls;
}

std::uint64_t RowSlices::bytes() const {
  std::uint64_t total = ids.size() * sizeof(std::uint32_t) + slices.size() * sizeof(slices.front());
  for (const std::vector<RowSegment>& slice : slices) total += slice.capacity() * sizeof(RowSegment);
  return total + (sums ? sums->bytes() : 0);
}

}  // namespace coordreq
