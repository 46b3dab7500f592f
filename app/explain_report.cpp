#include "app/reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "answers/field_parts.hpp"
#include "answers/one_cell/action_text.hpp"
#include "answers/requirements/answer.hpp"
#include "answers/step_codes.hpp"
#include "app/query_report.hpp"
#include "app/render.hpp"
#include "app/requirement_text.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

void add_delay(Json& json, std::int32_t delay, bool is_lower_bound) {
  json["delay"] = delay_json(delay);
  json["delay_status"] = is_lower_bound ? "at_least" : delay_label(delay);
}

Json centre_json(const UniformGrid& grid, std::int64_t cell) {
  Json json = Json::object();
  for (std::size_t i = 0; i < grid.size(); ++i)
    json[grid[i].name] = nearest_double(grid[i].point(grid.index(cell, i)));
  return json;
}

Json freedom_json(const DelayExplanation& found, const StoredPartition& partition) {
  Json json = {{"together", found.together}, {"alone", found.alone}, {"classes", Json::array()}};
  for (std::size_t c = 0; c < found.actions.size(); ++c) {
    const std::vector<bool>& admissible = found.actions[c];
    json["classes"].push_back({{"name", partition.classes[c]},
                               {"admissible", std::count(admissible.begin(), admissible.end(), true)},
                               {"total", admissible.size()}});
  }
  return json;
}

Json remedy_json(const DelayExplanation::Remedy& remedy, std::size_t partition,
                 const ResultsReader& results) {
  const ProblemSpec& spec = results.spec();
  const std::vector<std::int32_t> inputs =
      inputs_of(spec, spec.coordination.partitions[partition].classes[remedy.class_number]);
  const std::vector<Rational> values = values_of(spec, inputs, static_cast<std::size_t>(remedy.action));
  Json json = {{"class", results.partitions()[partition].classes[remedy.class_number]},
               {"inputs", Json::object()}};
  for (std::size_t i = 0; i < inputs.size(); ++i)
    json["inputs"][spec.inputs[static_cast<std::size_t>(inputs[i])].name] = nearest_double(values[i]);
  add_delay(json, remedy.delay, remedy.delay != kUnbounded);
  return json;
}

Counterexample path_of(const Json& found) {
  return {.path = found["way_out"], .kind = RequirementKind::min_delay, .partition = found["partition"]};
}

Counterexample silent_path(const Json& found) {
  return {.path = found["silence"]["way_out"],
          .kind = RequirementKind::min_silence,
          .partition = found["partition"]};
}

Json silence_json(const DelayExplanation::Silence& found, std::size_t partition,
                  const ResultsReader& results) {
  const ProblemSpec& spec = results.spec();
  const Field& field = results.field("/silence");
  Json json;
  json["silence"] = delay_json(found.steps);
  json["silence_status"] = found.is_lower_bound ? "at_least" : status_of(field, found.steps);
  json["classes"] = Json::array();
  for (std::size_t c = 0; c < found.actions.size(); ++c) {
    const std::vector<bool>& actions = found.actions[c];
    const auto permitted = std::count(actions.begin(), actions.end(), true);
    const auto& agents = spec.coordination.partitions[partition].classes[c];
    json["classes"].push_back(
        {{"name", results.partitions()[partition].classes[c]},
         {"permitted", permitted},
         {"total", actions.size()},
         {"actions", permitted == 0 ? Json() : Json(action_text(spec, agents, actions))}});
  }
  Json& path = json["way_out"] = Json();
  if (!found.path) return json;
  path = path_json(*found.path, RequirementKind::min_silence, spec);
  // The file does not say where it goes from there.
  if (path["end_sample"].is_object() && path["end_sample"]["silence_status"] == "not_in_silence_set")
    path["end"] = "outside_silence_set";
  return json;
}

std::string silence_text(const Json& silence, const ProblemSpec& spec) {
  const std::string status = text_of(silence["silence_status"]);
  if (status == "not_safe") return "none: the cell is not safe";
  if (status == "not_invariant") return "none: no coordination keeps the system safe from here";
  if (status == "not_in_silence_set") return "none: the fallback rule does not keep the system safe";
  if (status == "unbounded") return "unbounded: safe indefinitely";
  return (status == "at_least" ? "at least " : "") + steps_text(number_of(silence["silence"]), spec);
}

/// Adds the actions of silent agents, and the path that breaks their promise.
void add_silence(const Json& found, const ProblemSpec& spec, std::vector<std::string>& text) {
  const Json& silence = found["silence"];
  std::vector<std::string> phrases;
  for (const Json& entry : silence["classes"]) {
    const bool is_all = entry["permitted"] == entry["total"];
    const std::string what = entry["permitted"] == 0 ? "no action"
                             : is_all                ? "any action"
                                                     : text_of(entry["actions"]);
    phrases.push_back(fmt::format("{} {}", line_of(entry["name"]), what));
  }
  text.push_back(fmt::format("During silence the rule permits here: {}.", list_text(phrases)));
  if (silence["way_out"].is_null()) return;
  for (std::string& sentence : counterexample_sentences(silent_path(found), spec))
    text.push_back(std::move(sentence));
}

std::string classes_are(const Json& freedom) {
  std::vector<std::string> phrases;
  for (const Json& entry : freedom["classes"]) {
    const bool is_all = entry["admissible"] == entry["total"];
    phrases.push_back(fmt::format("{} {}{}", line_of(entry["name"]),
                                  is_all ? "all " : grouped(entry["admissible"]) + " of ",
                                  grouped(entry["total"])));
  }
  return list_text(phrases);
}

/// Adds the actions that are left to the classes, with their meaning.
void add_freedom(const Json& found, const ProblemSpec& spec, std::vector<std::string>& text) {
  const Json& freedom = found["freedom"];
  text.push_back(fmt::format("Actions that the controller permits here: {}.", classes_are(freedom)));
  const std::int64_t alone = number_of(freedom["alone"]), together = number_of(freedom["together"]);
  if (alone == together) {
    text.push_back("Every independent choice of these keeps the next state in the invariance set.");
  } else {
    const bool has_rule = spec.controller.allow || spec.controller.file;
    text.push_back(fmt::format(
        "If each class chooses independently, {} joint actions are possible; {} of them {} the next state "
        "in the invariance set.",
        grouped(freedom["alone"]), grouped(freedom["together"]), has_rule ? "are allowed and keep" : "keep"));
  }
}

void add_neighbour(const Json& found, const ProblemSpec& spec, std::vector<std::string>& text) {
  const Json& other = found["freer_is_shorter"];
  if (other.is_null()) return;
  const std::string delay = other["delay_status"] == "unbounded"
                                ? "the delay is unbounded"
                                : "the delay is " + steps_text(number_of(other["delay"]), spec);
  text.push_back(
      fmt::format("At {} {}, with {} instead of {}: the controller permits every action that joint "
                  "coordination can still correct, so a larger action set can shorten the delay.",
                  values_text(other["state"]), delay, count_of(number_of(other["alone"]), "joint action"),
                  grouped(found["freedom"]["alone"])));
}

void add_remedies(const Json& found, const ProblemSpec& spec, std::vector<std::string>& text) {
  for (const Json& entry : found["remedies"]) {
    const std::string much =
        entry["delay_status"] == "unbounded"
            ? "the delay would be unbounded"
            : fmt::format("the delay would be at least {}", steps_text(number_of(entry["delay"]), spec));
    text.push_back(fmt::format("If \"allow\" permitted {} only {} here, {}.", line_of(entry["class"]),
                               values_text(entry["inputs"]), much));
  }
  if (found["remedies"].empty())
    text.push_back("No restriction of one class to a single action here makes the delay longer.");
}

std::vector<std::string> sentences_of(const Json& found, const ProblemSpec& spec) {
  std::vector<std::string> text;
  const std::string status = text_of(found["delay_status"]);
  if (status == "not_safe") return {"The cell is not safe."};
  if (found.value("over", false))
    return {"The goal is reached here and the task ends: later states do not matter."};
  if (!found["way_out"].is_null()) text = counterexample_sentences(path_of(found), spec);
  if (status == "not_invariant") return text;
  if (status == "unbounded")
    text.emplace_back("Every independent choice leads only to cells with unbounded delay.");
  if (status == "at_least")
    text.emplace_back("\"max_delay\" ended the search, so there may be no path out of the invariance set.");
  add_freedom(found, spec, text);
  if (found["way_out"].is_null()) return text;
  add_neighbour(found, spec, text);
  add_remedies(found, spec, text);
  return text;
}

std::string delay_text(const Json& found, const ProblemSpec& spec) {
  const std::string status = text_of(found["delay_status"]);
  if (status == "not_safe") return "none: the cell is not safe";
  if (status == "not_invariant") return "none: on this grid no coordination keeps the system safe from here";
  if (found.value("over", false)) return "unbounded: the task is over here";
  if (status == "unbounded") return "unbounded: safe without coordination indefinitely";
  return (status == "at_least" ? "at least " : "") + steps_text(number_of(found["delay"]), spec);
}

std::string path_text(const char* title, const Counterexample& found, const ProblemSpec& spec) {
  if (found.path.is_null() || found.path["steps"].empty()) return "";
  return fmt::format("\n{}\n{}", title, counterexample_text(found, spec, ""));
}

}  // namespace

Json explanation_json(const DelayExplanation& found, const std::vector<Rational>& state, std::int64_t cell,
                      std::size_t partition, const ResultsReader& results) {
  const ProblemSpec& spec = results.spec();
  const UniformGrid& grid = results.grid();
  Json json;
  json["name"] = spec.name;
  json["state"] = Json::object();
  for (std::size_t i = 0; i < grid.size(); ++i) json["state"][grid[i].name] = nearest_double(state[i]);
  json["cell"] = cell;
  json["center"] = centre_json(grid, cell);
  json["partition"] = results.partitions()[partition].name;
  add_delay(json, found.delay, found.is_lower_bound);
  if (spec.ends_at_goal()) json["over"] = found.is_terminal;
  json["way_out"] = found.path ? path_json(*found.path, RequirementKind::min_delay, spec) : Json();
  const bool is_in_k = found.delay >= 0;
  json["freedom"] = is_in_k ? freedom_json(found, results.partitions()[partition]) : Json();
  json["remedies"] = Json::array();
  for (const DelayExplanation::Remedy& remedy : found.remedies)
    json["remedies"].push_back(remedy_json(remedy, partition, results));
  for (const Explained& explained : found.others) json[explained.key] = *explained.json;
  if (found.silence) json["silence"] = silence_json(*found.silence, partition, results);
  json["freer_is_shorter"] = Json();
  if (const auto& other = found.freer_is_shorter) {
    Json& entry =
        json["freer_is_shorter"] = {{"state", centre_json(grid, other->cell)}, {"cell", other->cell}};
    add_delay(entry, other->delay, false);
    entry["alone"] = other->alone;
  }
  json["sentences"] = sentences_of(json, spec);
  if (found.silence && json["silence"]["silence_status"] != "not_safe") {
    std::vector<std::string> text;
    add_silence(json, spec, text);
    for (const std::string& sentence : text) json["sentences"].push_back(sentence);
  }
  for (const Explained& explained : found.others) {
    for (const std::string& sentence : explained.sentences) json["sentences"].push_back(sentence);
  }
  return json;
}

std::string explanation_text(const Json& explanation, const ProblemSpec& spec) {
  Facts facts = {{"state", values_text(explanation["state"])},
                 {"cell", fmt::format("number {}, around {}", grouped(explanation["cell"]),
                                      values_text(explanation["center"]))},
                 {"partition", line_of(explanation["partition"])},
                 {"delay", delay_text(explanation, spec)}};
  const bool has_silence = explanation.contains("silence");
  if (has_silence) facts.emplace_back("silence", silence_text(explanation["silence"], spec));
  std::string text =
      facts_text(facts) + path_text("shortest path out of the invariance set", path_of(explanation), spec);
  if (has_silence)
    text += path_text("shortest path under the communication-loss rule", silent_path(explanation), spec);
  text += "\n";
  for (const Json& sentence : explanation["sentences"]) text += text_of(sentence) + "\n";
  return text;
}

}  // namespace coordreq
