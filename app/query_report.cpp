#include "app/query_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/json_text.hpp"
#include "app/text.hpp"
#include "trigger/trigger_table.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kMostTuples = 6;

/// A number at a length that can be read: exact if that is short, else rounded to six digits.
std::string shown(const Rational& value) {
  constexpr std::size_t kShort = 12;
  std::string text = to_text(value);
  return text.size() <= kShort ? text : fmt::format("{:.6g}", nearest_double(value));
}

std::string steps_text(std::int64_t steps, const ResultsReader& results) {
  const ProblemSpec& spec = results.spec();
  return duration(steps, nearest_double(spec.dynamics.period), spec.dynamics.unit);
}

/// "x1 in [0.095, 0.105)" for every state, "lane = 1" for a discrete one.
std::string box_text(const UniformGrid& grid, std::int64_t cell) {
  const CellBox box = box_of_cell(grid, cell);
  std::string text;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    text += text.empty() ? "" : ", ";
    text += grid[i].discrete
                ? fmt::format("{} = {}", grid[i].name, shown(box.centre[i]))
                : fmt::format("{} in [{}, {})", grid[i].name, shown(box.lower[i]), shown(box.upper[i]));
  }
  return text;
}

std::string state_text(const StateAnswer& answer, const UniformGrid& grid) {
  std::string text;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    text += fmt::format("{}{} = {}", i == 0 ? "" : ", ", grid[i].name, shown(answer.state[i]));
  }
  return text;
}

/// Why there is no cell.
std::string outside_text(const StateAnswer& answer, const UniformGrid& grid) {
  const Location& location = answer.location;
  const GridDimension& dimension = grid[location.dimension];
  const char* const side = location.above ? "above" : "below";
  const std::string value = fmt::format("{} = {}", dimension.name, shown(answer.state[location.dimension]));
  if (location.kind == Location::Kind::off_grid) {
    return fmt::format("no state of the system: {} is none of {} + k * {}", value, shown(dimension.first),
                       shown(dimension.step));
  }
  if (location.kind == Location::Kind::left_safely) {
    return fmt::format("outside: {} has left {} the domain, where the spec says that all is safe for ever",
                       value, side);
  }
  const Rational low = dimension.first - dimension.radius();
  const Rational high = dimension.point(dimension.count - 1) + dimension.radius();
  return fmt::format("outside: {} lies {} the domain, {} in [{}, {}{}; nothing is known there", value, side,
                     dimension.name, shown(low), shown(high), dimension.discrete ? "]" : ")");
}

std::string collision_text(const StateAnswer& answer, const ResultsReader& results) {
  if (answer.collision_time == ResultsReader::kNever) return "never, with coordination";
  if (answer.collision_time == 0) return "0 steps: not safe now";
  return "within " + steps_text(answer.collision_time, results) + ", whatever is coordinated";
}

std::string delay_text(std::int32_t delay, bool truncated, const ResultsReader& results) {
  if (delay == -2) return "none: the cell is not safe";
  if (delay == -1) return "none: no coordination keeps the system safe from here";
  if (delay == ResultsReader::kNever) return "unbounded: safe without coordination for ever";
  return (truncated ? "at least " : "") + steps_text(delay, results);
}

std::string trigger_text(std::int32_t trigger, const ResultsReader& results) {
  if (trigger == TriggerTable::kMustBeConnected) return "a connection must stand already";
  if (trigger < 0) return "none";
  if (trigger == ResultsReader::kNever) return "never need to connect";
  if (trigger == 0) {
    return results.spec().coordination.connection_delay > 0 ? "start to connect now" : "coordinate now";
  }
  return steps_text(trigger, results);
}

/// The largest finite delay of a truncated partition is a lower bound only.
bool is_lower_bound(std::int32_t delay, const StoredPartition& partition) {
  return partition.truncated() && delay + 1 == static_cast<std::int64_t>(partition.layer_sizes.size());
}

/// Values of the inputs of a joint action of a class.
std::vector<Rational> values_of(const ProblemSpec& spec, const std::vector<std::int32_t>& inputs,
                                std::size_t action) {
  std::vector<Rational> values(inputs.size());
  for (std::size_t j = inputs.size(); j-- > 0;) {
    const std::vector<Rational>& choices = spec.inputs[static_cast<std::size_t>(inputs[j])].values;
    values[j] = choices[action % choices.size()];
    action /= choices.size();
  }
  return values;
}

std::string tuple_text(const std::vector<Rational>& values) {
  std::string text;
  for (const Rational& value : values) text += (text.empty() ? "" : ", ") + shown(value);
  return values.size() == 1 ? text : "(" + text + ")";
}

/// Runs of actions that follow one another as "-0.8 ... 1"; of several inputs the first few tuples.
std::string actions_text(const ProblemSpec& spec, const std::vector<std::int32_t>& inputs,
                         const std::vector<bool>& actions) {
  std::string text;
  std::size_t shown = 0;
  for (std::size_t a = 0; a < actions.size(); ++a) {
    if (!actions[a]) continue;
    if (shown++ == kMostTuples) return text + " ...";
    text += (text.empty() ? "" : inputs.size() == 1 ? ", " : " ") + tuple_text(values_of(spec, inputs, a));
    std::size_t last = a;
    while (inputs.size() == 1 && last + 1 < actions.size() && actions[last + 1]) ++last;
    if (last > a) text += (last > a + 1 ? " ... " : ", ") + tuple_text(values_of(spec, inputs, last));
    a = last;
  }
  return text;
}

std::string class_text(const ProblemSpec& spec, const std::vector<std::int32_t>& inputs,
                       const std::vector<bool>& actions) {
  const auto count = std::count(actions.begin(), actions.end(), true);
  const auto total = static_cast<std::int64_t>(actions.size());
  if (count == 0) return "none";
  if (count == total) return fmt::format("all {}", grouped(total));
  std::vector<std::string> names;
  for (const std::int32_t i : inputs) names.push_back(spec.inputs[static_cast<std::size_t>(i)].name);
  const std::string name = names.size() == 1 ? names.front() : fmt::format("({})", fmt::join(names, ", "));
  return fmt::format("{} of {}: {} = {}", grouped(std::int64_t{count}), grouped(total), name,
                     actions_text(spec, inputs, actions));
}

std::string partition_text(const StateAnswer::Partition& answer, std::size_t p,
                           const ResultsReader& results) {
  const StoredPartition& stored = results.partitions()[p];
  Table table({Table::Align::left, Table::Align::left});
  table.add({"  delay", delay_text(answer.delay, is_lower_bound(answer.delay, stored), results)});
  table.add({"  countdown", trigger_text(answer.trigger, results)});
  for (std::size_t c = 0; c < answer.actions.size(); ++c) {
    const auto inputs = inputs_of_class(results.spec(), results.spec().coordination.partitions[p].classes[c]);
    table.add({"  actions of " + stored.classes[c], class_text(results.spec(), inputs, answer.actions[c])});
  }
  return fmt::format("\npartition {}\n{}", stored.name, table.text());
}

Json numbers_json(const std::vector<Rational>& values, const UniformGrid& grid) {
  Json json = Json::object();
  for (std::size_t i = 0; i < grid.size(); ++i) json[grid[i].name] = nearest_double(values[i]);
  return json;
}

Json cell_json(const UniformGrid& grid, const Location& location) {
  const CellBox box = box_of_cell(grid, location.cell);
  Json json;
  json["number"] = location.cell;
  json["index"] = location.index;
  json["center"] = numbers_json(box.centre, grid);
  json["lower"] = numbers_json(box.lower, grid);
  json["upper"] = numbers_json(box.upper, grid);
  return json;
}

const char* rule_word(const GridDimension& dimension, const Location& location) {
  switch (location.above ? dimension.above : dimension.below) {
    case Outside::safe:
      return "safe";
    case Outside::saturate:
      return "saturate";
    case Outside::stop:
      return "stop";
    default:
      return "unsafe";
  }
}

Json outside_json(const UniformGrid& grid, const Location& location) {
  const GridDimension& dimension = grid[location.dimension];
  Json json;
  json["state"] = dimension.name;
  if (location.kind == Location::Kind::off_grid) {
    json["reason"] = "off_grid";
    return json;
  }
  json["reason"] = "beyond";
  json["side"] = location.above ? "above" : "below";
  json["rule"] = rule_word(dimension, location);
  return json;
}

/// A number of steps, or null and a word why there is none.
void add_steps(Json& json, const std::string& name, std::int32_t steps, const char* status,
               const ResultsReader& results) {
  const bool finite = steps >= 0 && steps != ResultsReader::kNever;
  const Rational time = results.spec().dynamics.period * Rational(static_cast<long>(steps));
  json[name] = finite ? Json(steps) : Json();
  json[name + "_time"] = finite ? Json(nearest_double(time)) : Json();
  json[name + "_status"] = status;
}

const char* delay_status(std::int32_t delay, const StoredPartition& partition) {
  if (delay == -2) return "not_safe";
  if (delay == -1) return "not_invariant";
  if (delay == ResultsReader::kNever) return "unbounded";
  return is_lower_bound(delay, partition) ? "at_least" : "steps";
}

const char* trigger_status(std::int32_t trigger) {
  if (trigger == TriggerTable::kMustBeConnected) return "connection_must_stand_already";
  if (trigger == -2) return "not_safe";
  if (trigger == -1) return "not_invariant";
  return trigger == ResultsReader::kNever ? "never" : "steps";
}

Json class_json(const ProblemSpec& spec, const std::string& name, const std::vector<std::int32_t>& inputs,
                const std::vector<bool>& actions) {
  Json json;
  json["name"] = name;
  json["inputs"] = Json::array();
  for (const std::int32_t i : inputs) json["inputs"].push_back(spec.inputs[static_cast<std::size_t>(i)].name);
  json["total"] = actions.size();
  json["actions"] = Json::array();
  json["values"] = Json::array();
  for (std::size_t a = 0; a < actions.size(); ++a) {
    if (!actions[a]) continue;
    json["actions"].push_back(a);
    Json tuple = Json::array();
    for (const Rational& value : values_of(spec, inputs, a)) tuple.push_back(nearest_double(value));
    json["values"].push_back(std::move(tuple));
  }
  return json;
}

Json partition_json(const StateAnswer::Partition& answer, std::size_t p, const ResultsReader& results) {
  const StoredPartition& stored = results.partitions()[p];
  Json json;
  json["name"] = stored.name;
  add_steps(json, "delay", answer.delay, delay_status(answer.delay, stored), results);
  add_steps(json, "countdown", answer.trigger, trigger_status(answer.trigger), results);
  json["classes"] = Json::array();
  for (std::size_t c = 0; c < answer.actions.size(); ++c) {
    const auto inputs = inputs_of_class(results.spec(), results.spec().coordination.partitions[p].classes[c]);
    json["classes"].push_back(class_json(results.spec(), stored.classes[c], inputs, answer.actions[c]));
  }
  return json;
}

Json json_of(const StateAnswer& answer, const ResultsReader& results) {
  const bool inside = answer.location.kind == Location::Kind::cell;
  const bool left_safely = answer.location.kind == Location::Kind::left_safely;
  Json json;
  json["state"] = numbers_json(answer.state, results.grid());
  json["guarantee"] = results.attributes().guarantee;
  json["inside"] = inside;
  json["outside"] = inside ? Json() : outside_json(results.grid(), answer.location);
  json["cell"] = inside ? cell_json(results.grid(), answer.location) : Json();
  json["safe"] = inside ? Json(answer.safe) : left_safely ? Json(true) : Json();
  json["invariant"] = inside ? Json(answer.invariant) : left_safely ? Json(true) : Json();
  const bool leaves = inside && answer.collision_time != ResultsReader::kNever;
  json["collision_time"] = leaves ? Json(answer.collision_time) : Json();
  json["partitions"] = Json::array();
  for (std::size_t p = 0; p < answer.partitions.size(); ++p) {
    json["partitions"].push_back(partition_json(answer.partitions[p], p, results));
  }
  return json;
}

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

}  // namespace

std::string answer_text(const StateAnswer& answer, const ResultsReader& results) {
  const UniformGrid& grid = results.grid();
  Table table({Table::Align::left, Table::Align::left});
  table.add({"state", state_text(answer, grid)});
  if (answer.location.kind != Location::Kind::cell) {
    table.add({"cell", outside_text(answer, grid)});
    return table.text();
  }
  table.add(
      {"cell", fmt::format("number {}, index ({}): {}", grouped(answer.location.cell),
                           fmt::join(answer.location.index, ", "), box_text(grid, answer.location.cell))});
  table.add({"safe set", answer.safe ? "inside" : "outside"});
  table.add({"invariance set", answer.invariant ? "inside" : "outside"});
  table.add({"leaves the safe set", collision_text(answer, results)});
  table.add({"guarantee", guarantee_text(results.attributes().guarantee)});
  std::string text = table.text();
  for (std::size_t p = 0; p < answer.partitions.size(); ++p) {
    text += partition_text(answer.partitions[p], p, results);
  }
  return text;
}

std::string answer_json(const StateAnswer& answer, const ResultsReader& results) {
  return json_text(json_of(answer, results));
}

std::string answer_json_line(const StateAnswer& answer, const ResultsReader& results) {
  return json_of(answer, results).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string answer_csv_header(const ResultsReader& results) {
  std::string line;
  for (const GridDimension& dimension : results.grid().dimensions()) line += dimension.name + ",";
  line += "inside,cell,safe,invariant,collision_time";
  for (const StoredPartition& partition : results.partitions()) {
    line += fmt::format(",delay:{0},countdown:{0}", partition.name);
    for (const std::string& name : partition.classes)
      line += fmt::format(",actions:{}:{}", partition.name, name);
  }
  return line + "\n";
}

std::string answer_csv_line(const StateAnswer& answer, const ResultsReader& results) {
  std::string line;
  for (const Rational& value : answer.state) line += fmt::format("{},", nearest_double(value));
  if (answer.location.kind != Location::Kind::cell) {
    const bool left_safely = answer.location.kind == Location::Kind::left_safely;
    line += left_safely ? "0,,1,1," : "0,,,,";
    for (const StoredPartition& partition : results.partitions()) {
      line += std::string(2 + partition.classes.size(), ',');
    }
    return line + "\n";
  }
  line += fmt::format("1,{},{:d},{:d},{}", answer.location.cell, answer.safe, answer.invariant,
                      csv_steps(answer.collision_time));
  for (const StateAnswer::Partition& partition : answer.partitions) {
    line += "," + csv_steps(partition.delay) + "," + csv_steps(partition.trigger);
    for (const std::vector<bool>& actions : partition.actions) line += "," + csv_actions(actions);
  }
  return line + "\n";
}

}  // namespace coordreq
