#include <nlohmann/json.hpp>

#include "answers/coalition/fields.hpp"
#include "answers/field_parts.hpp"
#include "app/json_text.hpp"
#include "app/network_report.hpp"
#include "app/print_answer.hpp"
#include "app/query_report.hpp"
#include "app/query_values.hpp"
#include "model/outside_word.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

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
  json["rule"] = outside_word(location.above ? dimension.above : dimension.below);
  return json;
}

/// A number of steps, or null and a word why there is none.
void add_steps(Json& json, const std::string& name, std::int32_t steps, const std::string& status,
               const ResultsReader& results) {
  const bool finite = steps >= 0 && steps != ResultsReader::kNever;
  const Rational time = results.spec().dynamics.period * Rational(static_cast<long>(steps));
  json[name] = finite ? Json(steps) : Json();
  json[name + "_time"] = finite ? Json(nearest_double(time)) : Json();
  json[name + "_status"] = status;
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

/// Steps of a field over partitions.
void add_steps(Json& json, const std::string& name, std::int32_t steps, const std::string& path,
               std::size_t p, const ResultsReader& results) {
  const Field& field = results.field(path);
  const bool is_lower_bound = results.lower_bound(field, p) == std::int64_t{steps};
  add_steps(json, name, steps, is_lower_bound ? "at_least" : status_of(field, steps), results);
}

Json classes_json(const std::vector<std::vector<bool>>& actions, std::size_t p,
                  const ResultsReader& results) {
  Json json = Json::array();
  for (std::size_t c = 0; c < actions.size(); ++c) {
    const auto inputs = inputs_of(results.spec(), results.spec().coordination.partitions[p].classes[c]);
    json.push_back(class_json(results.spec(), results.partitions()[p].classes[c], inputs, actions[c]));
  }
  return json;
}

/// On the way to the goal.
Json approach_json(const StateAnswer::Approach& approach, std::size_t p, const ResultsReader& results) {
  Json json;
  add_steps(json, "delay", approach.delay, "/approach_delay", p, results);
  add_steps(json, "countdown", approach.trigger, "/approach_trigger", p, results);
  json["classes"] = classes_json(approach.actions, p, results);
  return json;
}

Json partition_json(const StateAnswer::Partition& answer, std::size_t p, const ResultsReader& results) {
  const StoredPartition& stored = results.partitions()[p];
  Json json;
  json["name"] = stored.name;
  add_steps(json, "delay", answer.delay, "/delay", p, results);
  add_steps(json, "countdown", answer.trigger, "/trigger", p, results);
  json["classes"] = classes_json(answer.actions, p, results);
  if (answer.approach) json["approach"] = approach_json(*answer.approach, p, results);
  return json;
}

Json coalition_json(const StateAnswer::Coalition& coalition, const ResultsReader& results) {
  const std::int32_t p = coalition.partition;
  Json json;
  json["horizon"] = *results.spec().coordination.horizon;
  json["partition"] = p >= 0 ? Json(results.partitions()[static_cast<std::size_t>(p)].name) : Json();
  json["status"] = p >= 0 ? "partition" : status_of(results.field(paths::kCoalition), p);
  json["critical_pairs"] = Json::array();
  for (const std::size_t pair : coalition.critical_pairs)
    json["critical_pairs"].push_back(results.pairs()[pair]);
  return json;
}

}  // namespace

Json answer_json(const StateAnswer& answer, const ResultsReader& results) {
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
  if (results.has_coalition())
    json["coalition"] = answer.coalition ? coalition_json(*answer.coalition, results) : Json();
  if (const auto& network = results.spec().network)
    json["safe_modes"] = inside ? Json(safe_mode_names(*network, answer.safe_modes)) : Json();
  if (results.spec().coordination.convention) json["convention"] = Json::array();
  for (std::size_t i = 0; i < answer.convention.size(); ++i) {
    const AgentSpec& agent = results.spec().agents[i];
    json["convention"].push_back(class_json(results.spec(), agent.name, agent.inputs, answer.convention[i]));
  }
  const std::vector<const Field*> others = asked_fields(results);
  for (std::size_t i = 0; i < others.size(); ++i) {
    const std::string name = others[i]->path.substr(1);
    json[name] = inside ? value_json(*others[i], answer.others[i]) : Json();
    json[name + "_status"] = inside ? Json(status_of(*others[i], answer.others[i])) : Json();
  }
  return json;
}

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

std::string answer_json_line(const StateAnswer& answer, const ResultsReader& results,
                             const std::vector<StateReader::Extra>* extra) {
  Json json = answer_json(answer, results);
  if (extra != nullptr) json["extra"] = Json::object();
  for (std::size_t i = 0; extra != nullptr && i < extra->size(); ++i)
    json["extra"][(*extra)[i].name] =
        (*extra)[i].is_json ? Json::parse((*extra)[i].value) : Json((*extra)[i].value);
  return json_line(json);
}

void print_state(const CommonOptions& asked, const StateAnswer& answer, const ResultsReader& results) {
  print_answer(asked, answer_json(answer, results),
               [&](const Json& found) { return answer_text(found, answer.state, results); });
}

}  // namespace coordreq
