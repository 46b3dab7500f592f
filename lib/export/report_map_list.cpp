#include "export/report_map_list.hpp"

#include <algorithm>
#include <cmath>

#include "answers/coalition/coalition_cost.hpp"

namespace coordreq {
namespace {

using Json = nlohmann::ordered_json;

ReportMap delay_map(const ResultsReader& results, std::size_t p) {
  return {{{"kind", "delay"}, {"partition", p}},
          [&results, p](const CellBlock& block) { return results.delay(p, block); },
          {}};
}

ReportMap coalition_map(const ResultsReader& results) {
  auto found = std::make_shared<std::set<std::int32_t>>();
  const auto read = [&results, found](const CellBlock& block) {
    std::vector<std::int32_t> values = results.coalition(block);
    found->insert(values.begin(), values.end());
    return values;
  };
  return {{{"kind", "coalition"}}, read, {}, found};
}

ReportMap member_map(const char* kind, std::shared_ptr<MemberMap> members) {
  return {{{"kind", kind}}, [members](const CellBlock& block) { return members->read(block); }, members};
}

ReportMap pair_map(const ResultsReader& results, const ReportLimits& limits) {
  const auto read = [&results](std::size_t pair, const CellBlock& block) {
    return results.critical_pair(pair, block);
  };
  return member_map(
      "pairs", std::make_shared<MemberMap>(results, read, results.pairs(), limits.members, limits.subsets));
}

ReportMap mode_map(const ResultsReader& results, const ReportLimits& limits) {
  const auto read = [&results](std::size_t mode, const CellBlock& block) {
    return results.network_safe(mode, 1, block);
  };
  std::vector<std::string> names;
  for (const NetworkModeSpec& mode : results.spec().network->modes) names.push_back(mode.name);
  return member_map(
      "modes", std::make_shared<MemberMap>(results, read, std::move(names), limits.members, limits.subsets));
}

/// Hundredths of a per cent; all and nothing are never the result of rounding.
std::int32_t share_code(float share) {
  constexpr std::int32_t kAll = 10000;
  if (share >= 1) return kAll;
  return std::clamp(static_cast<std::int32_t>(std::lround(share * float{kAll})), 1, kAll - 1);
}

ReportMap freedom_map(const ResultsReader& results, std::size_t agent) {
  const auto read = [&results, agent](const CellBlock& block) {
    std::vector<std::int32_t> values = results.collision_time(block);
    const std::vector<float> freedom = results.convention_freedom(agent, block);
    for (std::size_t x = 0; x < values.size(); ++x) {
      values[x] = values[x] == ResultsReader::kNever ? share_code(freedom[x]) : values[x] == 0 ? -2 : -1;
    }
    return values;
  };
  return {{{"kind", "freedom"}, {"agent", results.spec().agents[agent].name}}, read, {}};
}

/// A field that has no way of its own to be drawn: the page learns what its values mean from its flags.
ReportMap plain_map(const ResultsReader& results, const Field& field) {
  Json meanings = Json::array();
  for (const FieldAttribute& attribute : field.attributes) {
    const auto* const flags = std::get_if<std::vector<FieldFlag>>(&attribute.value);
    if (flags == nullptr) continue;
    for (const FieldFlag& flag : *flags) {
      std::string word = flag.word;
      std::replace(word.begin(), word.end(), '_', ' ');
      meanings.push_back({flag.value == kLargestValue ? Json("infinite") : Json(flag.value), word});
    }
  }
  return {{{"kind", field.path.substr(1)}, {"title", field.shown.map}, {"meanings", meanings}},
          [&results, &field](const CellBlock& block) { return results.values(field, std::nullopt, block); },
          {}};
}

/// The partitions that occur, the most wanted first, with what they cost.
Json choices_json(const ResultsReader& results, const std::set<std::int32_t>& found) {
  Json choices = Json::array();
  for (const CoalitionChoice& choice : order_of_preference(results.spec().coordination)) {
    if (found.contains(static_cast<std::int32_t>(choice.partition)))
      choices.push_back({{"partition", choice.partition}, {"cost", nearest_double(choice.cost)}});
  }
  return choices;
}

}  // namespace

std::vector<ReportMap> list_maps(const ResultsReader& results, const std::vector<std::size_t>& partitions,
                                 const ReportLimits& limits) {
  std::vector<ReportMap> maps;
  maps.reserve(partitions.size() + 1);
  for (const std::size_t p : partitions) maps.push_back(delay_map(results, p));
  maps.push_back({{{"kind", "collision_time"}},
                  [&results](const CellBlock& block) { return results.collision_time(block); },
                  {}});
  if (results.has_coalition()) {
    maps.push_back(coalition_map(results));
    if (!results.pairs().empty()) maps.push_back(pair_map(results, limits));
  }
  if (results.spec().network) maps.push_back(mode_map(results, limits));
  if (results.spec().coordination.convention) {
    for (std::size_t i = 0; i < std::min(results.spec().agents.size(), limits.agents); ++i)
      maps.push_back(freedom_map(results, i));
  }
  for (const Field& field : results.fields()) {
    if (!field.shown.map.empty()) maps.push_back(plain_map(results, field));
  }
  return maps;
}

std::vector<PackedMap> pack_listed(const ResultsReader& results, ReportMap& map,
                                   const std::vector<ReportCells>& sets) {
  PackedMaps packed = pack_map(results.grid(), map.read, sets);
  while (map.members && !map.members->fits()) {
    map.members->halve();
    packed = pack_map(results.grid(), map.read, sets);
  }
  map.head["largest"] = packed.largest;
  map.head["flags"] = Json::array();
  for (const std::int32_t flag : packed.flags)
    map.head["flags"].push_back(flag == ResultsReader::kNever ? Json("infinite") : Json(flag));
  if (map.members) {
    map.head["members"] = map.members->names();
    map.head["total"] = map.members->total();
    map.head["sets"] = map.members->sets();
  }
  if (map.coalitions) map.head["choices"] = choices_json(results, *map.coalitions);
  return std::move(packed.sets);
}

}  // namespace coordreq
