#include "answers/countdown/delay_layers.hpp"

#include <algorithm>
#include <utility>

#include "base/requires.hpp"
#include "choices/independent_actions.hpp"
#include "engine/find_levels.hpp"

namespace coordreq {
namespace {

template <class Level>
std::unique_ptr<RowOperator<Level>> make_operator(const Projections& projections, const CellSet& base,
                                                  int workers) {
  return std::make_unique<IndependentActions<Level>>(projections, base, workers);
}

/// |Z_0|, |Z_1|, ...: a cell of level i is in the first i layers.
std::vector<std::int64_t> layer_sizes(const LevelMap::Histogram& cells) {
  std::vector<std::int64_t> sizes(std::max<std::size_t>(cells.finite.size(), 1), cells.top);
  for (std::size_t level = sizes.size(); level-- > 1;) sizes[level - 1] = sizes[level] + cells.finite[level];
  return sizes;
}

}  // namespace

LevelMap find_layer_levels(const RowEngine& engine, const RowHull& hull, const CellSet& base,
                           const Projections& projections, const std::vector<const LevelMap*>& coarser,
                           std::optional<std::int64_t> max_delay, const WaveWatch& watch, ThreadTeam& team,
                           WaveCounts& counts, const CellSet* terminal) {
  const int workers = team.size();
  const LevelProblem problem{
      .start = &base,
      .spared = terminal,
      .bounds = coarser,
      .equal = projections.equal_work(),
      .limit = max_delay.value_or(-1),
      .make8 = [&] { return make_operator<std::uint8_t>(projections, base, workers); },
      .make16 = [&] { return make_operator<std::uint16_t>(projections, base, workers); },
      .make32 = [&] { return make_operator<std::uint32_t>(projections, base, workers); }};
  return find_levels(engine, hull, problem, watch, team, counts);
}

DelayLayers coordinated_layers(const RowEngine& engine, const CellSet& invariant,
                               std::optional<std::int64_t> max_delay, ThreadTeam& team, bool interned) {
  DelayLayers result{.layers_of = LevelMap(engine.make_levels<std::uint8_t>(invariant, team, interned))};
  follow_from_levels(max_delay, team, result);
  return result;
}

void follow_from_levels(std::optional<std::int64_t> max_delay, ThreadTeam& team, DelayLayers& layers,
                        const DelayLayers* beside) {
  layers.sizes = layer_sizes(layers.layers_of.histogram(team));
  const auto steps = static_cast<std::int64_t>(layers.sizes.size()) - 1;
  const std::int64_t fixed =
      beside == nullptr ? steps : std::max<std::int64_t>(steps, beside->fixed_point_index);
  // It takes one more step to know that a layer is a fixed point.
  layers.truncated = max_delay && layers.sizes.back() != 0 &&
                     (fixed >= *max_delay || (beside != nullptr && beside->truncated));
  layers.fixed_point_index = layers.truncated ? -1 : static_cast<std::int32_t>(steps);
  if (layers.truncated && beside != nullptr)
    layers.sizes.resize(static_cast<std::size_t>(*max_delay) + 1, layers.sizes.back());
}

std::int32_t trigger_of(std::int32_t delay, std::int64_t connection_delay) {
  REQUIRES(connection_delay >= 0);
  if (delay < 0) return delay;
  if (delay == kUnbounded) return kUnbounded;
  if (delay < connection_delay) return kMustBeConnected;
  return static_cast<std::int32_t>(delay - connection_delay);
}

}  // namespace coordreq
