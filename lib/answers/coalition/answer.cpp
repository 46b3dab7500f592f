#include "answers/coalition/answer.hpp"

#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>

#include "answers/checking/all_checks.hpp"
#include "answers/invariance/answer.hpp"
#include "answers/layers/answer.hpp"
#include "answers/paths.hpp"
#include "spec/partition_names.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

void find_coalition_map(Answers& answers, const StageWork& work) {
  const ProblemSpec& spec = answers.context.spec;
  std::vector<const DelayLayers*> layers;
  for (const DelayLayers& its_layers : answers.get<PartitionLayers>().partitions)
    layers.push_back(&its_layers);
  answers.add(find_coalitions(spec.coordination, spec.agents.size(), answers.get<Invariance>().invariant,
                              layers, work.team));
}

Json coalition_json(const CoalitionMap& map, const ProblemSpec& spec) {
  const Rational steps(static_cast<long>(map.horizon));
  Json json;
  json["horizon"] = map.horizon;
  json["horizon_time"] = nearest_double(Rational(spec.dynamics.period * steps));
  json["partitions"] = Json::array();
  for (std::size_t i = 0; i < map.choices.size(); ++i) {
    json["partitions"].push_back({{"name", spec.coordination.partitions[map.choices[i].partition].name},
                                  {"cost", nearest_double(map.choices[i].cost)},
                                  {"cells", map.cells[i]}});
  }
  json["no_partition_suffices"] = map.without;
  json["critical_pairs"] = Json::array();
  for (std::size_t i = 0; i < map.pairs.size(); ++i)
    json["critical_pairs"].push_back(
        {{"name", pair_name(spec, map.pairs[i])}, {"cells", map.critical_cells[i]}});
  return json;
}

/// Adds CoalitionMap, if the spec has a horizon: "coalitions".
std::vector<Stage> coalition_stages(const ProblemSpec& spec) {
  if (!spec.coordination.horizon) return {};
  return {{"coalitions", find_coalition_map}};
}

void summarise_coalition(const Answers& answers, Json& summary, Json& /*work*/) {
  const auto* const map = answers.find<CoalitionMap>();
  summary["coalition"] = map == nullptr ? Json() : coalition_json(*map, answers.context.spec);
}

void describe_coalition(const ProblemSpec& spec, const FieldSource& source, Json& info) {
  Json& json = info["coalition"] = Json();
  if (!spec.coordination.horizon) return;
  const std::vector<std::uint64_t> given = source.counted(paths::kCoalition);
  const std::vector<std::uint64_t> critical = source.counted(paths::kCriticalPair);
  json["horizon"] = *spec.coordination.horizon;
  json["partitions"] = Json::array();
  for (std::size_t p = 0; p < given.size(); ++p)
    json["partitions"].push_back({{"name", spec.coordination.partitions[p].name}, {"cells", given[p]}});
  json["no_partition_suffices"] =
      given.empty() ? Json()
                    : Json(std::accumulate(given.begin(), given.end(), info["invariant"].get<std::int64_t>(),
                                           std::minus<>()));
  json["critical_pairs"] = Json::array();
  const std::vector<std::string> pairs = pair_names(spec);
  for (std::size_t i = 0; i < critical.size(); ++i)
    json["critical_pairs"].push_back({{"name", pairs[i]}, {"cells", critical[i]}});
}

MemoryNeed coalition_memory(const EngineSizes& sizes, int /*threads*/) {
  const ProblemSpec& spec = sizes.model().spec();
  if (!spec.coordination.horizon) return {};
  const auto pairs = static_cast<double>(agent_pairs(spec.agents.size()).size());
  const bool is_short = spec.coordination.partitions.size() < LevelRows<std::uint8_t>::kTop;
  const double width = is_short ? sizeof(std::uint8_t) : sizeof(std::uint32_t);
  return {.kept = sizes.lanes() * width + pairs * sizes.set(), .array = pairs * sizes.cells()};
}

}  // namespace

std::string pair_name(const ProblemSpec& spec, const AgentPair& pair) {
  return class_name(spec.agents, {pair.first, pair.second});
}

const Answer coalition_answer = {.stages = coalition_stages,
                                 .memory = coalition_memory,
                                 .fields = coalition_fields,
                                 .fill = fill_coalition_fields,
                                 .summarise = summarise_coalition,
                                 .describe = describe_coalition,
                                 .check = check_coalition};

}  // namespace coordreq
