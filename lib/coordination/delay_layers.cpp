#include "coordination/delay_layers.hpp"

#include "safety/invariance.hpp"
#include "safety/wave.hpp"

namespace coordreq {
namespace {

struct Workspace {
  RowEngine::Scratch scratch;
  RowGroups groups;
  std::vector<Word> reasonable;
  std::vector<Word> inside;
};

/// Clears from `keep` the cells where some u in IND_C(x) has a post that is blocked or not inside `current`.
void independent_predecessor(const RowEngine& engine, const Projections& projections, std::int64_t row,
                             const CellSet& current, MutableRow keep, Workspace& work) {
  const ActionGrouping& grouping = projections.grouping();
  grouping.group(row, work.groups);
  work.inside.resize(keep.size());
  ActionGrouping::Tuples tuple(grouping, row, work.groups);
  do {
    work.reasonable.assign(keep.begin(), keep.end());
    for (std::size_t c = 0; c < grouping.size(); ++c) {
      const ConstRow projection = projections.row(row, work.groups, c, tuple.chosen()[c]);
      for (std::size_t w = 0; w < keep.size(); ++w) work.reasonable[w] &= projection[w];
    }
    if (!any_set(work.reasonable)) continue;
    engine.inside(tuple.slice_ids(), current, work.inside, work.scratch);
    for (std::size_t w = 0; w < keep.size(); ++w) keep[w] &= ~(work.reasonable[w] & ~work.inside[w]);
  } while (tuple.next());
}

std::vector<std::int32_t> initial_delays(const CellSet& safe, const CellSet& invariant) {
  std::vector<std::int32_t> delay(static_cast<std::size_t>(safe.cells()), DelayLayers::kOutsideSafe);
  for (std::int64_t r = 0; r < safe.rows(); ++r) {
    std::int32_t* row = delay.data() + r * safe.row_length();
    for_each_bit(safe.row(r), [&](std::int64_t c) { row[c] = DelayLayers::kOutsideInvariant; });
    for_each_bit(invariant.row(r), [&](std::int64_t c) { row[c] = DelayLayers::kUnbounded; });
  }
  return delay;
}

}  // namespace

DelayLayers find_delay_layers(const RowEngine& engine, const RowReach& reach, const CellSet& safe,
                              const CellSet& invariant, const Projections& projections,
                              std::optional<std::int64_t> max_delay,
                              const std::function<void(std::int64_t, std::int64_t)>& stepped,
                              ThreadTeam& team) {
  DelayLayers result{.delay = initial_delays(safe, invariant), .sizes = {invariant.count()}};
  std::vector<Workspace> work(static_cast<std::size_t>(team.size()));
  CellSet layer = invariant;
  const Wave wave{
      .shrink =
          [&](std::int64_t row, const CellSet& current, MutableRow keep, int worker) {
            independent_predecessor(engine, projections, row, current, keep,
                                    work[static_cast<std::size_t>(worker)]);
          },
      .removed =
          [&](std::int64_t row, ConstRow removed, std::int64_t step) {
            std::int32_t* delays = result.delay.data() + row * layer.row_length();
            for_each_bit(removed, [&](std::int64_t c) { delays[c] = static_cast<std::int32_t>(step - 1); });
          },
      .stepped =
          [&](std::int64_t step, std::int64_t cells_left) {
            if (cells_left != result.sizes.back()) result.sizes.push_back(cells_left);
            if (stepped) stepped(step, cells_left);
          }};
  const WaveResult run = run_wave(layer, wave, reach, max_delay.value_or(-1), team);
  result.truncated = !run.fixed_point && result.sizes.back() != 0;
  result.fixed_point_index = result.truncated ? -1 : static_cast<std::int32_t>(result.sizes.size() - 1);
  if (result.truncated) {
    for (std::int32_t& delay : result.delay) {
      if (delay == DelayLayers::kUnbounded) delay = static_cast<std::int32_t>(*max_delay);
    }
  }
  return result;
}

}  // namespace coordreq
