#include "app/analysis_json.hpp"

#include <nlohmann/json.hpp>

namespace coordreq {
namespace {

Json partition_json(const PartitionSummary& partition) {
  Json json;
  json["name"] = partition.name;
  json["classes"] = partition.classes;
  json["F"] = partition.truncated ? Json() : Json(partition.fixed_point_index);
  json["fixed_point"] = partition.truncated ? Json() : Json(partition.fixed_point);
  json["layers"] = partition.layers;
  json["truncated"] = partition.truncated;
  json["never_without_connection"] = partition.never_without_connection;
  json["max_delay_time"] = partition.max_delay_time ? Json(*partition.max_delay_time) : Json();
  return json;
}

Json coalition_json(const CoalitionSummary& coalition) {
  Json json;
  json["horizon"] = coalition.horizon;
  json["horizon_time"] = coalition.horizon_time;
  json["partitions"] = Json::array();
  for (const CoalitionSummary::Choice& choice : coalition.choices)
    json["partitions"].push_back(
        {{"name", choice.partition}, {"cost", choice.cost}, {"cells", choice.cells}});
  json["no_partition_suffices"] = coalition.without;
  json["critical_pairs"] = Json::array();
  for (const auto& [pair, count] : coalition.critical_pairs)
    json["critical_pairs"].push_back({{"name", pair}, {"cells", count}});
  return json;
}

Json network_json(const NetworkSummary& summary) {
  Json json;
  json["kind"] = summary.kind;
  json["resynthesise"] = summary.resynthesise;
  json["initial"] = summary.modes.front().name;
  json["modes"] = Json::array();
  for (const NetworkSummary::Mode& mode : summary.modes)
    json["modes"].push_back(Json{{"name", mode.name}, {"partition", mode.partition}, {"cells", mode.cells}});
  json["cells_in_every_mode"] = summary.every_mode;
  return json;
}

Json requirements_json(const AnalysisSummary& summary, const ProblemSpec& spec) {
  Json all = Json::array();
  for (std::size_t r = 0; r < summary.requirements.size(); ++r)
    all.push_back(requirement_json(summary.requirements[r], spec.requirements[r], spec));
  return all;
}

}  // namespace

Json summary_json(const AnalysisSummary& summary, const ProblemSpec& spec) {
  Json json;
  json["name"] = summary.name;
  json["states"] = summary.states;
  json["inputs"] = summary.inputs;
  if (const std::optional<ControllerSummary>& controller = summary.controller) {
    json["controller"] = {
        {"file", controller->file}, {"sha256", controller->sha256}, {"pairs", controller->pairs}};
  }
  json["safe"] = summary.safe;
  json["invariant"] = summary.invariant;
  json["iterations"] = summary.iterations;
  json["guarantee"] = summary.guarantee;
  json["period"] = summary.period;
  json["period_unit"] = summary.period_unit;
  json["connection_delay"] = summary.connection_delay;
  json["partitions"] = Json::array();
  for (const PartitionSummary& partition : summary.partitions)
    json["partitions"].push_back(partition_json(partition));
  json["coalition"] = summary.coalition ? coalition_json(*summary.coalition) : Json();
  if (summary.network) json["network"] = network_json(*summary.network);
  for (const ConventionSummary& own : summary.convention) {
    json["convention"].push_back(
        Json{{"agent", own.agent}, {"mean", own.mean}, {"full", own.full}, {"histogram", own.histogram}});
  }
  json["requirements"] = requirements_json(summary, spec);
  json["output"] = summary.output.empty() ? Json() : Json(summary.output);
  json["threads"] = summary.threads;
  json["seconds"] = Json::object();
  for (const auto& [stage, seconds] : summary.seconds) json["seconds"][stage] = seconds;
  json["work"] = Json::object();
  for (const AnalysisSummary::Work& work : summary.work) {
    json["work"][work.stage] = {
        {"sweeps", work.sweeps}, {"rows_visited", work.rows_visited}, {"rows_skipped", work.rows_skipped}};
  }
  json["peak_memory_bytes"] = summary.peak_memory_bytes;
  return json;
}

}  // namespace coordreq
