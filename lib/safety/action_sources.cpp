#include "safety/action_sources.hpp"

#include <map>

namespace coordreq {

std::vector<ActionSource> action_sources(const RowEngine& engine) {
  std::vector<ActionSource> sources;
  for (const RowSlices& slices : engine.slices()) {
    ActionSource& source = sources.emplace_back();
    source.shared_ids = &slices.ids;
    source.is_summed = slices.sums.has_value();
    source.state_stride = slices.state_stride;
    source.input_stride = slices.input_stride;
    source.inputs = slices.inputs;
    source.input_combinations = slices.input_combinations;
  }
  const ConditionTable* allow = engine.allow();
  if (allow == nullptr) return sources;
  ActionSource& source = sources.emplace_back();
  source.state_stride = allow->state_stride();
  source.input_stride = allow->input_stride();
  source.inputs = allow->inputs();
  for (const std::int32_t i : source.inputs) {
    source.input_combinations *= engine.abstraction().inputs[static_cast<std::size_t>(i)].count();
  }
  std::map<std::vector<Word>, std::uint32_t> numbers;
  for (std::int64_t r = 0; r < allow->bits().rows(); ++r) {
    const ConstRow bits = allow->bits().row(r);
    const auto next = static_cast<std::uint32_t>(numbers.size());
    source.own_ids.push_back(numbers.try_emplace({bits.begin(), bits.end()}, next).first->second);
  }
  return sources;
}

}  // namespace coordreq
