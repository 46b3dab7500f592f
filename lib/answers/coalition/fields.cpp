#include "answers/coalition/fields.hpp"

#include "answers/coalition/coalition_cost.hpp"
#include "answers/field_parts.hpp"
#include "answers/layers/delay_layers.hpp"
#include "spec/partition_names.hpp"

namespace coordreq {

std::vector<std::string> pair_names(const ProblemSpec& spec) {
  std::vector<std::string> names;
  for (const AgentPair& pair : agent_pairs(spec.agents.size()))
    names.push_back(class_name(spec.agents, {pair.first, pair.second}));
  return names;
}

Fields coalition_fields(const ProblemSpec& spec) {
  if (!spec.coordination.horizon) return {};
  const std::size_t partitions = spec.coordination.partitions.size();
  Fields fields = {
      {.path = paths::kCoalition,
       .section = FieldSection::maps,
       .types = {ElementType::int16, ElementType::int32},
       .axes = cell_axes(spec),
       .least = kNoPartitionSuffices,
       .most = static_cast<std::int64_t>(partitions) - 1,
       .attributes =
           described("index into partition of the cheapest one that is safe without further contact for the "
                     "horizon") +
           std::vector<FieldAttribute>{{"horizon", *spec.coordination.horizon}} + counted_cells(partitions) +
           std::vector<FieldAttribute>{flags({{kNoPartitionSuffices, "no_partition_suffices"},
                                              {DelayLayers::kOutsideSafe, "not_safe"},
                                              {DelayLayers::kOutsideInvariant, "not_invariant"}})}}};
  std::vector<std::string> pairs = pair_names(spec);
  if (pairs.empty()) return fields;
  const std::size_t count = pairs.size();
  fields.push_back(name_scale("/pair", FieldSection::names, std::move(pairs), "pair of agents"));
  fields.push_back(
      {.path = paths::kCriticalPair,
       .section = FieldSection::maps,
       .types = {ElementType::uint8},
       .axes = cell_axes("/pair", spec),
       .most = 1,
       .attributes = described("the two are together in every partition of least cost that suffices") +
                     counted_cells(count) +
                     std::vector<FieldAttribute>{flags({{0, "not_critical"}, {1, "critical"}})}});
  return fields;
}

}  // namespace coordreq
