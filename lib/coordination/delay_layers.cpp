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

/// True if every cell of `keep` in `a` is in `b`.
bool subset_within(ConstRow a, ConstRow b, ConstRow keep) {
  for (std::size_t w = 0; w < keep.size(); ++w) {
    if ((a[w] & ~b[w] & keep[w]) != 0) return false;
  }
  return true;
}

/// The groups of class c that can make a difference: reasonable somewhere in `keep`, and not with a post
/// inside that of another group that is reasonable wherever they are.
std::vector<std::uint32_t> worst_groups(const Projections& projections, std::int64_t row,
                                        const RowGroups& groups, std::size_t c, ConstRow keep) {
  const ActionGroups& own = *groups.classes[c];
  const std::vector<Word> nowhere(keep.size(), 0);
  std::vector<std::uint32_t> result;
  for (std::uint32_t g = 0; g < own.size(); ++g) {
    const ConstRow projection = projections.row(row, groups, c, g);
    bool needed = !subset_within(projection, nowhere, keep);
    for (std::uint32_t h = 0; h < own.size() && needed; ++h) {
      if (h == g || !own.is_within(g, h)) continue;
      const bool mutual = own.is_within(h, g);
      const ConstRow other = projections.row(row, groups, c, h);
      // Of two that cover each other the lower one stays.
      if (subset_within(projection, other, keep)) {
        needed = mutual && g < h && subset_within(other, projection, keep);
      }
    }
    if (needed) result.push_back(g);
  }
  return result;
}

/// Clears from `keep` the cells where some u in IND_C(x) has a post that is blocked or not inside `current`.
void independent_predecessor(const RowEngine& engine, const Projections& projections, std::int64_t row,
                             const RowTarget& current, MutableRow keep, Workspace& work) {
  const ActionGrouping& grouping = projections.grouping();
  grouping.group(row, work.groups);
  work.inside.resize(keep.size());
  std::vector<std::vector<std::uint32_t>> candidates;
  for (std::size_t c = 0; c < grouping.size(); ++c) {
    candidates.push_back(worst_groups(projections, row, work.groups, c, keep));
    if (candidates.back().empty()) return;
  }
  ActionGrouping::Tuples tuple(grouping, row, work.groups, std::move(candidates));
  do {
    work.reasonable.assign(keep.begin(), keep.end());
    for (std::size_t c = 0; c < grouping.size(); ++c) {
      const ConstRow projection = projections.row(row, work.groups, c, tuple.chosen(c));
      for (std::size_t w = 0; w < keep.size(); ++w) work.reasonable[w] &= projection[w];
    }
    if (!any_set(work.reasonable)) continue;
    engine.inside(tuple.slice_ids(), current, work.inside, work.scratch);
    for (std::size_t w = 0; w < keep.size(); ++w) keep[w] &= ~(work.reasonable[w] & ~work.inside[w]);
    if (!any_set(keep)) return;
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
          [&](std::int64_t row, const RowTarget& current, MutableRow keep, int worker) {
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
  const WaveResult run = run_wave(layer, wave, engine, reach, max_delay.value_or(-1), team);
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
