#include "export/report_data.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "answers/paths.hpp"
#include "answers/requirements/result_requirement.hpp"
#include "base/json.hpp"
#include "export/report_maps.hpp"
#include "spec/problem_spec.hpp"
#include "spec/requirement_kind.hpp"

namespace coordreq {
namespace {

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
    if (results.spec().dynamics.is_kept(i)) state["kept"] = true;
    state["points"] = Json::array();
    for (std::int64_t k = 0; k < dimension.count; ++k)
      state["points"].push_back(nearest_double(dimension.point(k)));
  }
  return states;
}

Json partitions_json(const ResultsReader& results) {
  Json partitions = Json::array();
  for (const StoredPartition& stored : results.partitions()) {
    partitions.push_back({{"name", stored.name},
                          {"classes", stored.classes.size()},
                          {"layers", stored.layer_sizes},
                          {"truncated", stored.truncated()}});
  }
  return partitions;
}

/// Packs the maps and completes their heads.
Json sets_json(const ResultsReader& results, std::vector<ReportMap>& maps,
               const std::vector<ReportCells>& sets) {
  Json all = Json::array();
  for (const ReportCells& cells : sets) {
    Json& set = all.emplace_back();
    set["shows"] = cells.shows ? Json{cells.shows->first, cells.shows->second} : Json();
    set["indices"] = cells.indices;
    set["maps"] = Json::array();
  }
  for (ReportMap& map : maps) {
    std::vector<PackedMap> packed = pack_listed(results, map, sets);
    for (std::size_t s = 0; s < sets.size(); ++s)
      all[s]["maps"].push_back({{"bytes", packed[s].bytes}, {"data", std::move(packed[s].data)}});
  }
  return all;
}

/// The kind of the map that shows what is required.
std::string kind_of_map(const ResultsReader& results, RequirementKind kind) {
  const std::string path = kind == RequirementKind::invariant ? "" : dataset_of(kind, results.spec()).path;
  return path.empty() || !results.has(path) ? "collision_time" : results.field(path).display.map.kind;
}

/// The cells that the counterexamples visit; `independent` steps lead out of K.
Json paths_json(const ResultsReader& results) {
  Json paths = Json::array();
  const std::vector<ResultRequirement> all = read_requirement_values(results.spec(), results);
  for (std::size_t r = 0; r < all.size(); ++r) {
    const ResultRequirement& requirement = all[r];
    if (!requirement.path) continue;
    Json& path = paths.emplace_back();
    const auto& partition = results.spec().requirements[r].partition;
    path["kind"] = kind_of_map(results, results.spec().requirements[r].kind);
    path["requirement"] = requirement.name;
    path["partition"] = partition ? Json(*partition) : Json();
    const auto& phase = requirement.path->phase;
    path["independent"] = std::count(phase.begin(), phase.end(), PathPhase::independent);
    path["cells"] = Json::array();
    for (const std::uint64_t cell : requirement.path->cell)
      path["cells"].push_back(index_of(results.grid(), static_cast<std::int64_t>(cell)));
  }
  return paths;
}

/// Where K is empty: the first cell from which the worst case takes longest to leave S, the best that there
/// is.
Json latest_json(const ResultsReader& results, const std::vector<std::int64_t>& best_cells) {
  if (std::any_of(best_cells.begin(), best_cells.end(), [](std::int64_t cell) { return cell >= 0; }))
    return {};
  const auto read = [&results](const CellBlock& block) {
    return results.values(paths::kCollisionTime, block);
  };
  const std::int64_t cell = first_largest(results.grid(), read);
  return cell < 0 ? Json() : Json(index_of(results.grid(), cell));
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
  for (const char c : compact_json(json)) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

double report_bytes(const ResultsReader& results, const ReportLimits& limits) {
  constexpr double kBytesOfValue = 2 * sizeof(std::int32_t);  // with its code, packed or not
  constexpr double kUsualPacked = 0.3, kCopies = 6;           // of the text, until it is in the page
  constexpr double kTemplate = 1.5 * 1024 * 1024;
  const auto cells = static_cast<double>(results.grid().cells());
  double maps = 0;
  for (const Field& field : results.fields()) {
    if (field.display.map.kind.empty()) continue;
    const std::size_t leading = results.leading_length(field);
    maps += static_cast<double>(std::clamp<std::size_t>(leading, 1, limits.partitions));
  }
  const double packed =
      std::min(static_cast<double>(limits.packed_bytes), kUsualPacked * cells * std::max(maps, 1.0));
  double points = 0;
  for (const GridDimension& dimension : results.grid().dimensions())
    points += static_cast<double>(dimension.count);
  // Every step of a counterexample is described in the text, and drawn.
  constexpr double kBytesOfNumber = 350;
  const auto numbers = static_cast<double>(results.grid().size() + results.inputs().size() + 2);
  double steps = 0;
  for (const ResultRequirement& requirement : read_requirement_values(results.spec(), results))
    steps += requirement.path ? static_cast<double>(requirement.path->cell.size()) : 0;
  constexpr double kBytesOfPoint = 100;  // a number in JSON, its text, and where it stands in a set of cells
  return results.reading_bytes() + kBytesOfValue * std::min(cells, static_cast<double>(limits.values)) +
         kCopies * packed + kBytesOfPoint * points + kBytesOfNumber * numbers * steps + kTemplate;
}

ReportData report_data(const ResultsReader& results, std::vector<std::size_t> partitions,
                       const ReportLimits& limits) {
  const UniformGrid& grid = results.grid();
  ReportData data;
  data.partitions = std::move(partitions);
  std::vector<ReportMap> maps = list_maps(results, data.partitions, limits);
  std::vector<std::vector<std::int64_t>> pins;
  for (std::size_t m = 0; m < data.partitions.size(); ++m) {
    data.best_cells.push_back(first_largest(grid, maps[m].read));
    if (data.best_cells.back() >= 0) pins.push_back(index_of(grid, data.best_cells.back()));
    (*maps[m].head)["best"] = data.best_cells.back() < 0 ? Json() : Json(pins.back());
  }
  const Json latest = latest_json(results, data.best_cells);
  if (!latest.is_null()) pins.push_back(latest.get<std::vector<std::int64_t>>());
  const Json paths = paths_json(results);
  for (const Json& path : paths) pins.push_back(path["cells"].front().get<std::vector<std::int64_t>>());
  Json json;
  json["period"] = results.attributes().period;
  json["unit"] = results.spec().dynamics.unit;
  json["connection_delay"] = results.spec().coordination.connection_delay;
  json["states"] = states_json(results);
  json["partitions"] = partitions_json(results);
  json["latest"] = latest;
  json["ways"] = paths;
  std::int64_t cells = std::max<std::int64_t>(limits.values / static_cast<std::int64_t>(maps.size()), 1);
  for (;; cells = std::min(cells, grid.cells()) / 2) {
    const std::vector<ReportCells> sets = choose_cells(grid, std::max<std::int64_t>(cells, 1), pins);
    json["sets"] = sets_json(results, maps, sets);
    data.is_whole = !sets.front().shows.has_value();
    if (packed_bytes(json["sets"]) <= limits.packed_bytes || cells <= 1) break;
  }
  json["maps"] = Json::array();
  for (ReportMap& map : maps) json["maps"].push_back(std::move(*map.head));
  data.json = text_of(json);
  return data;
}

}  // namespace coordreq
