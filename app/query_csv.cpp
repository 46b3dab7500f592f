#include <fmt/format.h>

#include "app/network_report.hpp"
#include "app/query_report.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

std::string csv_steps(std::int32_t steps) {
  return steps == ResultsReader::kNever ? "inf" : std::to_string(steps);
}

std::string csv_actions(const std::vector<bool>& actions) {
  std::string text;
  for (std::size_t a = 0; a < actions.size(); ++a) {
    if (actions[a]) text += (text.empty() ? "" : " ") + std::to_string(a);
  }
  return text;
}

/// The number of the partition, or the code for why there is none, and the names of pairs.
std::string csv_coalition(const StateAnswer::Coalition& coalition, const ResultsReader& results) {
  std::string pairs;
  for (const std::size_t pair : coalition.critical_pairs)
    pairs += (pairs.empty() ? "" : " ") + results.pairs()[pair];
  return fmt::format(",{},{}", coalition.partition, pairs);
}

/// A column that is no state; states may have its name.
std::string answer_column(const std::string& name, const ResultsReader& results) {
  const auto& states = results.grid().dimensions();
  const bool is_taken =
      std::ranges::any_of(states, [&](const GridDimension& state) { return state.name == name; });
  return (is_taken ? "answer:" : "") + name;
}

/// A field as it stands in CSV (RFC 4180).
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + "\"";
}

/// Everything but what stood beside the state.
std::string header_of_answers(const ResultsReader& results) {
  std::string line;
  for (const GridDimension& dimension : results.grid().dimensions()) line += dimension.name + ",";
  line += fmt::format("{},{},safe,invariant,collision_time", answer_column("inside", results),
                      answer_column("cell", results));
  for (const StoredPartition& partition : results.partitions()) {
    line += fmt::format(",delay:{0},countdown:{0}", partition.name);
    for (const std::string& name : partition.classes)
      line += fmt::format(",actions:{}:{}", partition.name, name);
    if (!results.spec().goal) continue;
    line += fmt::format(",approach_delay:{0},approach_countdown:{0}", partition.name);
    for (const std::string& name : partition.classes)
      line += fmt::format(",approach_actions:{}:{}", partition.name, name);
  }
  if (results.has_coalition()) line += ",coalition," + answer_column("critical_pairs", results);
  if (results.spec().network) line += "," + answer_column("safe_modes", results);
  if (results.spec().coordination.convention) {
    for (const AgentSpec& agent : results.spec().agents) line += ",convention:" + agent.name;
  }
  for (const Field* const field : asked_fields(results)) line += "," + field->path.substr(1);
  return line;
}

std::string line_of_answers(const StateAnswer& answer, const ResultsReader& results) {
  std::string line;
  for (const Rational& value : answer.state) line += fmt::format("{},", nearest_double(value));
  if (answer.location.kind != Location::Kind::cell) {
    const bool left_safely = answer.location.kind == Location::Kind::left_safely;
    line += left_safely ? "0,,1,1," : "0,,,,";
    for (const StoredPartition& partition : results.partitions()) {
      line += std::string((results.spec().goal ? 2 : 1) * (2 + partition.classes.size()), ',');
    }
    if (results.has_coalition()) line += ",,";
    if (results.spec().network) line += ",";
    if (results.spec().coordination.convention) line += std::string(results.spec().agents.size(), ',');
    return line + std::string(asked_fields(results).size(), ',');
  }
  line += fmt::format("1,{},{:d},{:d},{}", answer.location.cell, answer.safe, answer.invariant,
                      csv_steps(answer.collision_time));
  for (const StateAnswer::Partition& partition : answer.partitions) {
    line += "," + csv_steps(partition.delay) + "," + csv_steps(partition.trigger);
    for (const std::vector<bool>& actions : partition.actions) line += "," + csv_actions(actions);
    if (!partition.approach) continue;
    line += "," + csv_steps(partition.approach->delay) + "," + csv_steps(partition.approach->trigger);
    for (const std::vector<bool>& actions : partition.approach->actions) line += "," + csv_actions(actions);
  }
  if (answer.coalition) line += csv_coalition(*answer.coalition, results);
  if (const auto& network = results.spec().network)
    line += fmt::format(",{}", fmt::join(safe_mode_names(*network, answer.safe_modes), " "));
  for (const std::vector<bool>& actions : answer.convention) line += "," + csv_actions(actions);
  for (const std::int32_t value : answer.others) line += "," + csv_steps(value);
  return line;
}

}  // namespace

std::string answer_csv_header(const ResultsReader& results, const std::vector<std::string>& extra) {
  std::string line = header_of_answers(results);
  const std::string taken = "," + line + ",";
  for (const std::string& name : extra) {
    const bool is_taken = taken.find("," + csv_field(name) + ",") != std::string::npos;
    line += "," + csv_field((is_taken ? "extra:" : "") + name);
  }
  return line + "\n";
}

std::string answer_csv_line(const StateAnswer& answer, const ResultsReader& results,
                            const std::vector<StateReader::Extra>& extra) {
  std::string line = line_of_answers(answer, results);
  for (const StateReader::Extra& own : extra) line += "," + csv_field(own.value);
  return line + "\n";
}

}  // namespace coordreq
