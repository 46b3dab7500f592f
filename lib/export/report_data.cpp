#include "export/report_data.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "export/report_maps.hpp"

namespace coordreq {
namespace {

using Json = nlohmann::ordered_json;

/// A map and what the page calls it.
struct Map {
  Json head;
  ReadCells read;
};

std::vector<Map> maps_of(const ResultsReader& results, const std::vector<std::size_t>& partitions) {
  std::vector<Map> maps;
  for (const std::size_t p : partitions) {
    maps.push_back({{{"kind", "delay"}, {"partition", p}},
                    [&results, p](const CellBlock& block) { return results.delay(p, block); }});
  }
  maps.push_back({{{"kind", "collision_time"}},
                  [&results](const CellBlock& block) { return results.collision_time(block); }});
  return maps;
}

std::vector<std::int64_t> index_of(const UniformGrid& grid, std::int64_t cell) {
  std::vector<std::int64_t> index;
  for (std::size_t i = 0; i < grid.size(); ++i) index.push_back(grid.index(cell, i));
  return index;
}

Json states_json(const ResultsReader& results) {
  Json states = Json::array();
  for (std::size_t i = 0; i < results.grid().size(); ++i) {
    const GridDimension& dimension = results.grid()[i];
    Json& state = states.emplace_back();
    state["name"] = dimension.name;
    state["unit"] = results.spec().states[i].unit;
    state["step"] = nearest_double(dimension.step);
    state["discrete"] = dimension.discrete;
    state["points"] = Json::array();
    for (std::int64_t k = 0; k < dimension.count; ++k)
      state["points"].push_back(nearest_double(dimension.point(k)));
  }
  return states;
}

Json partitions_json(const ResultsReader& results) {
  Json partitions = Json::array();
  for (const StoredPartition& stored : results.partitions()) {
    partitions.push_back(
        {{"name", stored.name}, {"layers", stored.layer_sizes}, {"truncated", stored.truncated()}});
  }
  return partitions;
}

/// Packs the maps; tells the largest value of each in its head.
Json sets_json(const ResultsReader& results, std::vector<Map>& maps, const std::vector<ReportCells>& sets) {
  Json all = Json::array();
  for (const ReportCells& cells : sets) {
    Json& set = all.emplace_back();
    set["shows"] = cells.shows ? Json{cells.shows->first, cells.shows->second} : Json();
    set["indices"] = cells.indices;
    set["maps"] = Json::array();
  }
  for (Map& map : maps) {
    PackedMaps packed = pack_map(results.grid(), map.read, sets);
    map.head["largest"] = packed.largest;
    map.head["flags"] = Json::array();
    for (const std::int32_t flag : packed.flags)
      map.head["flags"].push_back(flag == ResultsReader::kNever ? Json("infinite") : Json(flag));
    for (std::size_t s = 0; s < sets.size(); ++s)
      all[s]["maps"].push_back({{"bytes", packed.sets[s].bytes}, {"data", std::move(packed.sets[s].data)}});
  }
  return all;
}

std::size_t packed_bytes(const Json& sets) {
  std::size_t bytes = 0;
  for (const Json& set : sets) {
    for (const Json& map : set["maps"]) bytes += map["data"].get_ref<const std::string&>().size();
  }
  return bytes;
}

/// A '<' cannot end the element that the text stands in.
std::string text_of(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

ReportData report_data(const ResultsReader& results, std::vector<std::size_t> partitions,
                       const ReportLimits& limits) {
  const UniformGrid& grid = results.grid();
  ReportData data;
  data.partitions = std::move(partitions);
  std::vector<Map> maps = maps_of(results, data.partitions);
  std::vector<std::vector<std::int64_t>> pins;
  for (std::size_t m = 0; m < data.partitions.size(); ++m) {
    data.best_cells.push_back(first_largest(grid, maps[m].read));
    if (data.best_cells.back() >= 0) pins.push_back(index_of(grid, data.best_cells.back()));
    maps[m].head["best"] = data.best_cells.back() < 0 ? Json() : Json(pins.back());
  }
  Json json;
  json["period"] = results.attributes().period;
  json["unit"] = results.spec().dynamics.unit;
  json["connection_delay"] = results.spec().coordination.connection_delay;
  json["states"] = states_json(results);
  json["partitions"] = partitions_json(results);
  std::int64_t cells = std::max<std::int64_t>(limits.values / static_cast<std::int64_t>(maps.size()), 1);
  for (;; cells = std::min(cells, grid.cells()) / 2) {
    const std::vector<ReportCells> sets = choose_cells(grid, std::max<std::int64_t>(cells, 1), pins);
    json["sets"] = sets_json(results, maps, sets);
    data.is_whole = !sets.front().shows.has_value();
    if (packed_bytes(json["sets"]) <= limits.packed_bytes || cells <= 1) break;
  }
  json["maps"] = Json::array();
  for (Map& map : maps) json["maps"].push_back(std::move(map.head));
  data.json = text_of(json);
  return data;
}

}  // namespace coordreq
