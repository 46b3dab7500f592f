#include <nlohmann/json.hpp>

#include "answers/field_parts.hpp"
#include "answers/paths.hpp"
#include "answers/plan.hpp"
#include "answers/step_codes.hpp"
#include "app/print.hpp"
#include "app/query_report.hpp"
#include "base/json.hpp"
#include "model/outside.hpp"
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
  json["rule"] = outside_name(location.above ? dimension.above : dimension.below);
  return json;
}

/// A number of steps, or null and a status that says why there is none.
void add_steps(Json& json, const std::string& name, std::int32_t steps, const std::string& status,
               const ResultsReader& results) {
  const bool finite = steps >= 0 && steps != kUnbounded;
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

/// Steps of a field by partition.
void add_steps(Json& json, const std::string& name, std::int32_t steps, const std::string& path,
               std::size_t p, const ResultsReader& results) {
  const Field& field = results.field(path);
  const bool is_lower_bound = results.lower_bound(field, p) == std::int64_t{steps};
  add_steps(json, name, steps, is_lower_bound ? "at_least" : status_of(field, steps), results);
}

Json classes_json(const ActionSets& actions, std::size_t p, const ResultsReader& results) {
  Json json = Json::array();
  for (std::size_t c = 0; c < actions.size(); ++c) {
    const auto inputs = inputs_of(results.spec(), results.spec().coordination.partitions[p].classes[c]);
    json.push_back(class_json(results.spec(), results.partitions()[p].classes[c], inputs, actions[c]));
  }
  return json;
}

Json agents_json(const ActionSets& actions, const ProblemSpec& spec) {
  Json json = Json::array();
  for (std::size_t i = 0; i < actions.size(); ++i)
    json.push_back(class_json(spec, spec.agents[i].name, spec.agents[i].inputs, actions[i]));
  return json;
}

void add_number(Json& json, const Field& field, std::int32_t value) {
  json[field.display.query.name] = value_json(field, value);
  json[field.display.query.name + "_status"] = status_of(field, value);
}

Json partition_json(const StateAnswer& answer, std::size_t p, const QueryForm& form) {
  Json json;
  json["name"] = form.results.partitions()[p].name;
  for (const AnswerPolicy& policy : form.policies) {
    Json& entry = policy.name.empty() ? json : json[policy.name];
    add_steps(entry, "delay", answer.value(policy.delay, p), policy.delay, p, form.results);
    if (!policy.trigger.empty())
      add_steps(entry, "countdown", answer.value(policy.trigger, p), policy.trigger, p, form.results);
    entry["classes"] = classes_json(answer.actions.at(policy.name)[p], p, form.results);
  }
  for (const Field* const field : form.numbers) {
    if (QueryForm::is_of_partitions(*field)) add_number(json, *field, answer.value(field->path, p));
  }
  return json;
}

/// A partition that is chosen, or why there is none; the probabilities of the entries of the leading axis;
/// else those that hold.
void add_to_section(Json& json, const Field& field, const std::vector<std::int32_t>& values,
                    const ResultsReader& results) {
  const FieldQuery& query = field.display.query;
  if (!query.attribute.empty()) json[query.attribute] = integer_attribute(field, query.attribute);
  if (field.kind == FieldKind::choice) {
    const std::int32_t p = values.front();
    json[query.name] = p >= 0 ? Json(results.partitions()[static_cast<std::size_t>(p)].name) : Json();
    json["status"] = p >= 0 ? query.name : status_of(field, p);
    return;
  }
  if (field.kind == FieldKind::probability) {
    for (std::size_t i = 0; i < values.size(); ++i)
      json[query.name][results.leading_names(field)[i]] = probability_of(values[i]);
    return;
  }
  Json& names = json[query.name] = Json::array();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] != 0) names.push_back(results.leading_names(field)[i]);
  }
}

}  // namespace

QueryForm::QueryForm(const ResultsReader& file) : results(file) {
  for (const AnswerPolicy& policy : answer_policies(file.spec()))
    (policy.is_by_agent ? of_agents : policies).push_back(policy);
  for (const Field* const field : query_fields(file)) {
    const bool is_number = (field->kind == FieldKind::steps || field->kind == FieldKind::probability) &&
                           (file.leading_length(*field) == 0 || is_of_partitions(*field));
    (is_number ? numbers : others).push_back(field);
  }
}

Json answer_json(const StateAnswer& answer, const QueryForm& form) {
  const ResultsReader& results = form.results;
  const bool inside = answer.location.kind == Location::Kind::cell;
  const bool left_safely = answer.location.kind == Location::Kind::left_safely;
  const auto is_in = [&](const char* set) {
    return inside ? Json(answer.value(set) != 0) : left_safely ? Json(true) : Json();
  };
  Json json;
  json["state"] = numbers_json(answer.state, results.grid());
  json["guarantee"] = results.attributes().guarantee;
  json["inside"] = inside;
  json["outside"] = inside ? Json() : outside_json(results.grid(), answer.location);
  json["cell"] = inside ? cell_json(results.grid(), answer.location) : Json();
  json["safe"] = is_in(paths::kSafe);
  json["invariant"] = is_in(paths::kInvariant);
  const bool leaves = inside && answer.value(paths::kCollisionTime) != kUnbounded;
  json["collision_time"] = leaves ? Json(answer.value(paths::kCollisionTime)) : Json();
  json["partitions"] = Json::array();
  for (std::size_t p = 0; inside && p < results.partitions().size(); ++p)
    json["partitions"].push_back(partition_json(answer, p, form));
  for (const Field* const field : form.others) {
    const FieldQuery& query = field->display.query;
    if (!inside) {
      json[query.group.empty() ? query.name : query.group] = Json();
    } else {
      add_to_section(query.group.empty() ? json : json[query.group], *field, answer.values.at(field->path),
                     results);
    }
  }
  for (const AnswerPolicy& policy : form.of_agents) {
    json[policy.name] =
        inside ? agents_json(answer.actions.at(policy.name).front(), form.spec()) : Json::array();
  }
  for (const Field* const field : form.numbers) {
    if (QueryForm::is_of_partitions(*field)) continue;
    if (inside) {
      add_number(json, *field, answer.value(field->path));
    } else {
      json[field->display.query.name] = Json();
      json[field->display.query.name + "_status"] = Json();
    }
  }
  return json;
}

std::string answer_json_line(const StateAnswer& answer, const QueryForm& form,
                             const std::vector<StateReader::Extra>* extra) {
  Json json = answer_json(answer, form);
  if (extra != nullptr) json["extra"] = Json::object();
  for (std::size_t i = 0; extra != nullptr && i < extra->size(); ++i)
    json["extra"][(*extra)[i].name] =
        (*extra)[i].is_json ? parse_json((*extra)[i].value) : Json((*extra)[i].value);
  return json_line(json);
}

void print_state(const CommonOptions& options, const StateAnswer& answer, const QueryForm& form) {
  print_answer(options, answer_json(answer, form),
               [&](const Json& found) { return answer_text(found, answer.state, form); });
}

}  // namespace coordreq
