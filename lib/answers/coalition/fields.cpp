#include <memory>
#include <nlohmann/json.hpp>

#include "answers/coalition/answer.hpp"
#include "answers/coalition/coalition_cost.hpp"
#include "answers/countdown/delay_layers.hpp"
#include "answers/field_arrays.hpp"
#include "answers/field_parts.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/paths.hpp"
#include "answers/step_codes.hpp"
#include "engine/convert_cells.hpp"
#include "spec/partition_names.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// [level of CoalitionMap::chosen] Its value in the file, kNoPartitionSuffices left out.
template <class Integer>
std::vector<Integer> codes(const CoalitionMap& map) {
  std::vector<Integer> result = {static_cast<Integer>(kOutsideInvariant)};
  for (const CoalitionChoice& choice : map.choices) result.push_back(static_cast<Integer>(choice.partition));
  return result;
}

template <class Integer>
FillArray fill_coalition(const CoalitionMap& map, const Answers& answers) {
  return
      [&map, &answers, code_of = codes<Integer>(map)](std::uint64_t begin, std::uint64_t count, void* out) {
        auto* const values = static_cast<Integer*>(out);
        map.chosen.visit([&]<class Level>(const LevelRows<Level>& levels) {
          convert_cells(levels, *answers.context.order, begin, count, values, [&](Level level) {
            return level == LevelRows<Level>::kTop ? static_cast<Integer>(kNoPartitionSuffices)
                                                   : code_of[static_cast<std::size_t>(level)];
          });
        });
        mark_unsafe(answers.get<Invariance>().collision_time, *answers.context.order, begin, count, values);
      };
}

ResultArray coalition_array(const CoalitionMap& map, const Answers& answers) {
  const ElementType type = level_type(static_cast<std::int64_t>(map.choices.size()) - 1);
  return {type, type == ElementType::int16 ? fill_coalition<std::int16_t>(map, answers)
                                           : fill_coalition<std::int32_t>(map, answers)};
}

/// The partitions that occur, the most preferred first, with their costs.
std::function<void(const std::set<std::int32_t>&, Json&)> choices_of(const CoordinationSpec& coordination) {
  return [stored = std::make_shared<const CoordinationSpec>(coordination)](
             const std::set<std::int32_t>& values, Json& head) {
    head["choices"] = Json::array();
    for (const CoalitionChoice& choice : order_of_preference(*stored)) {
      if (values.contains(static_cast<std::int32_t>(choice.partition)))
        head["choices"].push_back({{"partition", choice.partition}, {"cost", nearest_double(choice.cost)}});
    }
  };
}

}  // namespace

std::vector<std::string> pair_names(const ProblemSpec& spec) {
  std::vector<std::string> names;
  for (const AgentPair& pair : agent_pairs(spec.agents.size()))
    names.push_back(class_name(spec.agents, {pair.first, pair.second}));
  return names;
}

/// The cheapest partition that is enough, and the pairs that cannot do without one another.
Fields coalition_fields(const ProblemSpec& spec) {
  if (!spec.coordination.horizon) return {};
  const std::size_t partitions = spec.coordination.partitions.size();
  Fields fields = {
      {.path = paths::kCoalition,
       .kind = FieldKind::choice,
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
                                              {kOutsideSafe, "not_safe"},
                                              {kOutsideInvariant, "not_invariant"}})},
       .display = {
           .query = {.name = "partition",
                     .label = "cheapest partition",
                     .meanings = {{"no_partition_suffices", "none: no partition of the file suffices"},
                                  {"not_safe", "none"},
                                  {"not_invariant", "none"}},
                     .group = "coalition",
                     .heading = "without further contact",
                     .attribute = "horizon"},
           .map = {.kind = "coalition", .legend = choices_of(spec.coordination)}}}};
  std::vector<std::string> pairs = pair_names(spec);
  if (pairs.empty()) return fields;
  const std::size_t count = pairs.size();
  fields.push_back(name_scale("/pair", FieldSection::names, std::move(pairs), "pair of agents"));
  fields.push_back(
      {.path = paths::kCriticalPair,
       .kind = FieldKind::set,
       .section = FieldSection::maps,
       .types = {ElementType::uint8},
       .axes = cell_axes("/pair", spec),
       .most = 1,
       .attributes = described("the two are together in every partition of least cost that suffices") +
                     counted_cells(count) +
                     std::vector<FieldAttribute>{flags({{0, "not_critical"}, {1, "critical"}})},
       .display = {.query = {.name = "critical_pairs", .label = "critical pairs", .group = "coalition"},
                   .map = {.kind = "pairs"}}});
  return fields;
}

/// Fills in the values of these fields. The arrays refer to the answers, which must outlive the writing.
void fill_coalition_fields(const Answers& answers, ThreadTeam& /*team*/, FieldValues& values) {
  const auto* const map = answers.find<CoalitionMap>();
  if (map == nullptr) return;
  std::vector<std::uint64_t> cells(map->choices.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    cells[map->choices[i].partition] = static_cast<std::uint64_t>(map->cells[i]);
  values.entries[paths::kCoalition] = {.array = coalition_array(*map, answers),
                                       .attributes = {{"cells", std::move(cells)}}};
  if (map->pairs.empty()) return;
  values.entries[paths::kCriticalPair] = {
      .array = sets_array(map->critical, *answers.context.order),
      .attributes = {
          {"cells", std::vector<std::uint64_t>(map->critical_cells.begin(), map->critical_cells.end())}}};
}

}  // namespace coordreq
