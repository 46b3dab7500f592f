#include "engine/action_sources.hpp"

namespace coordreq {

ActionSource source_of(const PairTable& pairs, const InputSpace& inputs) {
  ActionSource source;
  source.ids = &pairs.ids();
  source.state_stride = pairs.positions().state_stride;
  source.input_stride = pairs.positions().input_stride;
  source.before = pairs.positions().before;
  source.inputs = pairs.positions().inputs;
  for (const std::int32_t i : source.inputs)
    source.input_combinations *= inputs[static_cast<std::size_t>(i)].count();
  return source;
}

std::vector<ActionSource> action_sources(const RowEngine& engine) {
  std::vector<ActionSource> sources;
  for (const RowSlices& slices : engine.slices()) {
    ActionSource& source = sources.emplace_back();
    source.slices = &slices;
    source.ids = slices.all_distinct() ? nullptr : &slices.ids;
    source.state_stride = slices.state_stride;
    source.input_stride = slices.input_stride;
    source.before = slices.before;
    source.inputs = slices.inputs;
    source.input_combinations = slices.input_combinations;
  }
  if (const PairTable* allow = engine.allow())
    sources.push_back(source_of(*allow, engine.abstraction().inputs));
  return sources;
}

}  // namespace coordreq
