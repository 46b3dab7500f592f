#include "engine/action_sources.hpp"

namespace coordreq {

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
  const PairTable* allow = engine.allow();
  if (allow == nullptr) return sources;
  ActionSource& source = sources.emplace_back();
  source.ids = &allow->ids();
  source.state_stride = allow->positions().state_stride;
  source.input_stride = allow->positions().input_stride;
  source.before = allow->positions().before;
  source.inputs = allow->positions().inputs;
  for (const std::int32_t i : source.inputs) {
    source.input_combinations *= engine.abstraction().inputs[static_cast<std::size_t>(i)].count();
  }
  return sources;
}

}  // namespace coordreq
