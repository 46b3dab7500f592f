#include "engine/row_hull.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "engine/row_window.hpp"
#include "model/pieces.hpp"

namespace coordreq {
namespace {

using Kind = RowSegment::Kind;
constexpr IndexRange kNone{0, -1};

/// On a ring, with its first index in [0, count).
IndexRange normal(IndexRange range, const GridDimension& target) {
  if (!target.periodic()) return range;
  const auto n = static_cast<std::int32_t>(target.count);
  const std::int32_t first = (range.first % n + n) % n;
  return {first, first + (range.last - range.first)};
}

}  // namespace

RowHull::RowHull(const RowEngine& engine) : engine_(&engine) {
  for (std::size_t t = 0; t < engine.tables(); ++t) {
    const RowSlices& slices = engine.slices()[t];
    std::vector<std::int64_t> all(static_cast<std::size_t>(slices.input_combinations));
    std::iota(all.begin(), all.end(), 0);
    std::optional<SumRows::Reader> reader;
    if (slices.sums) reader.emplace(*slices.sums);
    std::vector<Entry>& entries = entries_.emplace_back();
    for (std::int64_t base = 0; base < slices.size(); base += slices.input_combinations)
      entries.push_back(entry(t, base, all, reader ? &*reader : nullptr));
  }
}

RowHull::Entry RowHull::entry(std::size_t table, std::int64_t base, std::span<const std::int64_t> offsets,
                              SumRows::Reader* reader) const {
  return reader != nullptr ? entry_of_sums(table, base, offsets, *reader)
                           : entry_of_slices(table, base, offsets);
}

RowHull::Entry RowHull::entry_of_slices(std::size_t table, std::int64_t base,
                                        std::span<const std::int64_t> offsets) const {
  const RowSlices& slices = engine_->slices()[table];
  const GridDimension& target = engine_->grid()[table];
  const bool is_along = table >= engine_->across();
  // A tube can block a post whatever its box is inside of.
  Entry result{kNone, engine_->demands().empty()};
  std::uint32_t previous = UINT32_MAX;
  for (const std::int64_t offset : offsets) {
    const std::uint32_t id = slices.ids[static_cast<std::size_t>(base + offset)];
    if (id == previous) continue;
    previous = id;
    const std::vector<RowSegment>& slice = slices.slices[id];
    const Kind expected = is_along ? Kind::shifted : Kind::fixed;
    result.covers = result.covers && slice.size() == 1 && slice[0].kind == expected;
    for (const RowSegment& segment : slice) {
      if (segment.kind != expected) continue;
      const IndexRange range = normal(segment.range, target);
      result.range = result.range == kNone ? range : merge_ranges(result.range, range, target);
    }
  }
  if (result.range == kNone) {
    result.covers = false;
  } else if (is_along) {
    const RowFamily posts = engine_->posts();
    const RowDimension& own = posts.shape.dimensions[table - engine_->across()];
    result.range = fit_window(result.range, target.count, own.ends);
    // On a ring the arc that holds two windows may begin with the other one, and reach beyond the margins.
    const RowMargins margins = own.margins;
    result.covers =
        result.covers && -result.range.first <= margins.before && result.range.last <= margins.after;
  } else if (target.periodic()) {
    result.range = wrap_range(result.range, target.count);
  }
  return result;
}

/// Sums are not looked at cell by cell, and none of their states wraps round.
RowHull::Entry RowHull::entry_of_sums(std::size_t table, std::int64_t base,
                                      std::span<const std::int64_t> offsets, SumRows::Reader& reader) const {
  const SumRows& sums = *engine_->slices()[table].sums;
  const bool is_last = table + 1 == engine_->tables();
  IndexRange raw{INT32_MAX, INT32_MIN};
  for (const std::int64_t offset : offsets) {
    const SumRows::Row row = reader.row(static_cast<std::uint32_t>(base + offset));
    const IndexRange range = is_last ? sums.offset_hull(row) : sums.hull(row);
    raw = {std::min(raw.first, range.first), std::max(raw.last, range.last)};
  }
  const GridDimension& target = engine_->grid()[table];
  const bool no_tubes = engine_->demands().empty();
  if (is_last) return {fit_window(raw, target.count, {target.below, target.above}), no_tubes};
  const auto last = static_cast<std::int32_t>(target.count - 1);
  // What leaves safely, or lands in the boundary cell, asks no more than the part of the box that is left.
  const bool blocks = (raw.first < 0 && traits(target.below).blocks) ||
                      (raw.last > last && traits(target.above).blocks);
  return {{std::clamp(raw.first, 0, last), std::clamp(raw.last, 0, last)}, no_tubes && !blocks};
}

void RowHull::box(const RowPlace& place, Box& box) const {
  box.resize(*engine_);
  box.covers = true;
  for (std::size_t t = 0; t < engine_->tables(); ++t) {
    const RowSlices& slices = engine_->slices()[t];
    const auto choice =
        static_cast<std::size_t>(place.offset(slices.state_stride) / slices.input_combinations);
    const Entry& entry = entries_[t][choice];
    box[t] = entry.range;
    box.covers = box.covers && entry.covers;
  }
}

}  // namespace coordreq
