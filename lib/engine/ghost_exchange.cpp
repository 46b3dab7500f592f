#include "engine/ghost_exchange.hpp"

namespace coordreq {
namespace {

/// From the first to the last number of the rows of a box. @param ranges as for for_each_row()
RowShare::Range span_of(const UniformGrid& grid, std::span<const IndexRange> ranges) {
  RowShare::Range rows{0, 1};
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const IndexRange range = ranges[i];
    if (range.first > range.last) return {0, 0};
    const bool is_around = range.last >= grid[i].count;  // on a ring, beyond its end
    rows.begin += grid.row_stride(i) * (is_around ? 0 : range.first);
    rows.end += grid.row_stride(i) * (is_around ? grid[i].count - 1 : range.last);
  }
  return rows;
}

/// From the first to the last number of the rows that posts of a unit can meet.
RowShare::Range span_of_posts(const RowEngine& engine, const RowHull& hull, std::int64_t unit_rows,
                              RowShare::Range rows, RowBox& box) {
  RowPosition position(engine.grid(), rows.begin);
  if (engine.outer() > 0) {
    hull.box(position, box);
    RowShare::Range span = span_of(engine.grid(), std::span(box.ranges).first(engine.outer()));
    span.end += span.begin == span.end ? 0 : unit_rows - 1;
    return span;
  }
  RowShare::Range all{0, 0};
  for (; position.row < rows.end; position.advance(engine.grid())) {
    hull.box(position, box);
    const RowShare::Range one = span_of(engine.grid(), box.ranges);
    if (one.begin == one.end) continue;
    all = all.begin == all.end ? one
                               : RowShare::Range{std::min(all.begin, one.begin), std::max(all.end, one.end)};
  }
  return all;
}

}  // namespace

std::vector<RowShare::Range> units_that_meet_peers(const RowEngine& engine, const RowHull& hull,
                                                   std::int64_t unit_rows) {
  const std::vector<RowShare::Peer>& peers = engine.share()->peers();
  std::vector<RowShare::Range> units(peers.size());
  const RowShare::Range local = engine.share()->local();
  RowBox box;
  for (std::int64_t begin = local.begin; begin < local.end;) {
    const std::int64_t unit = begin / unit_rows;
    const std::int64_t end = std::min((unit + 1) * unit_rows, local.end);
    const RowShare::Range span = span_of_posts(engine, hull, unit_rows, {begin, end}, box);
    begin = end;
    if (local.begin <= span.begin && span.end <= local.end) continue;
    for (std::size_t p = 0; p < peers.size(); ++p) {
      const RowShare::Range run = engine.share()->run_of(peers[p].rank);
      if (span.end <= run.begin || run.end <= span.begin) continue;
      if (units[p].begin == units[p].end) units[p].begin = unit;
      units[p].end = unit + 1;
    }
  }
  return units;
}

ExchangeTimes find_times(const SweepOrder& order, RowShare::Range meeting, RowShare::Range sent) {
  const auto has = [](RowShare::Range units, std::int64_t unit) {
    return units.begin <= unit && unit < units.end;
  };
  ExchangeTimes times;
  for (std::size_t batch = 0; batch < order.size(); ++batch) {
    for (const std::uint32_t unit : order[batch].units) {
      if (times.taking == ExchangeTimes::kNever && has(meeting, unit)) times.taking = batch;
      if (has(sent, unit)) times.sending = batch;
    }
  }
  return times;
}

}  // namespace coordreq
