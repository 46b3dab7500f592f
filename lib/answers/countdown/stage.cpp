#include "answers/countdown/stage.hpp"

#include <algorithm>

#include "answers/countdown/best_cells.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

LevelBounds layer_bounds(const AnalysisContext& context, const CellSet& base) {
  const std::int64_t steps = context.engine->grid().points();
  return {&base, std::min(context.spec.coordination.max_delay.value_or(steps), steps)};
}

void find_layers(const AnalysisContext& context, const RowEngine& engine, const CellSet& base,
                 const StageWork& work, DelayLayers& layers,
                 const std::function<LevelMap(const WaveWatch& watch, WaveCounts& counts)>& find,
                 const DelayLayers* beside) {
  find_or_take_levels(work, engine, layer_bounds(context, base), layers.layers_of,
                      [&](const WaveWatch& watch) { return find(watch, layers.counts); });
  follow_from_levels(context.spec.coordination.max_delay, work.team, layers, beside);
  find_best_cells(context, work.team, layers);
}

}  // namespace coordreq
