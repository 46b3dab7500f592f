#include "answers/countdown/delay_layers.hpp"

#include <algorithm>
#include <utility>

#include "choices/independent_actions.hpp"
#include "engine/find_levels.hpp"

namespace coordreq {
namespace {

template <class Level>
std::unique_ptr<RowOperator<Level>> make_operator(const Projections& projections, const CellSet& invariant,
                                                  int workers) {
  return std::make_unique<IndependentActions<Level>>(projections, invariant, workers);
}

/// |Z_0|, |Z_1|, ...: a cell of level i is in the first i layers.
std::vector<std::int64_t> layer_sizes(const LevelMap::Histogram& cells) {
  std::vector<std::int64_t> sizes(std::max<std::size_t>(cells.finite.size(), 1), cells.top);
  for (std::size_t level = sizes.size(); level-- > 1;) sizes[level - 1] = sizes[level] + cells.finite[level];
  return sizes;
}

}  // namespace

DelayLayers find_delay_layers(const RowEngine& engine, const RowHull& hull, const CellSet& invariant,
                              const Projections& projections, const std::vector<const LevelMap*>& coarser,
                              std::optional<std::int64_t> max_delay, const WaveWatch& watch, ThreadTeam& team,
                              const CellSet* over) {
  const int workers = team.size();
  const LevelProblem problem{
      .start = &invariant,
      .spared = over,
      .bounds = coarser,
      .equal = projections.equal_work(),
      .limit = max_delay.value_or(-1),
      .make8 = [&] { return make_operator<std::uint8_t>(projections, invariant, workers); },
      .make16 = [&] { return make_operator<std::uint16_t>(projections, invariant, workers); },
      .make32 = [&] { return make_operator<std::uint32_t>(projections, invariant, workers); }};
  WaveCounts counts;
  DelayLayers result{.layers_of = find_levels(engine, hull, problem, watch, team, counts)};
  result.counts = counts;
  follow_from_levels(max_delay, team, result);
  return result;
}

DelayLayers coordinated_layers(const RowEngine& engine, const CellSet& invariant,
                               std::optional<std::int64_t> max_delay, ThreadTeam& team, bool interned) {
  DelayLayers result{.layers_of = LevelMap(engine.make_levels<std::uint8_t>(invariant, team, interned))};
  follow_from_levels(max_delay, team, result);
  return result;
}

void follow_from_levels(std::optional<std::int64_t> max_delay, ThreadTeam& team, DelayLayers& result) {
  result.sizes = layer_sizes(result.layers_of.histogram(team));
  const auto steps = static_cast<std::int64_t>(result.sizes.size()) - 1;
  // It takes one more step to know that a layer is a fixed point.
  result.truncated = max_delay && steps >= *max_delay && result.sizes.back() != 0;
  result.fixed_point_index = result.truncated ? -1 : static_cast<std::int32_t>(steps);
}

}  // namespace coordreq
