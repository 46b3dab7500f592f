#include "app/judge_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "answers/requirements/answer.hpp"
#include "app/render.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

constexpr std::array<LogFinding, kLogFindings> kAllLogFindings = {
    LogFinding::outside,  LogFinding::unsafe,          LogFinding::not_invariant, LogFinding::off_model,
    LogFinding::reckless, LogFinding::not_coordinated, LogFinding::breach};

bool is_of_states(const std::string& finding) {
  return finding == "outside" || finding == "unsafe" || finding == "not_invariant";
}

/// "3 steps", of a number or of what there is instead.
std::string silence_text(const Json& of, const char* key, const Json& document) {
  return of[key].is_null() ? "any silence" : duration(of[key], document);
}

std::string delay_text(const Json& first, const Json& document) {
  const std::string status = text_of(first["delay_status"]);
  if (status == "not_safe") return "is not safe";
  if (status == "not_invariant") return "is outside the invariance set";
  return "tolerates " + silence_text(first, "delay", document);
}

/// Values of inputs, those that are logged.
std::string inputs_text(const Json& first) {
  Json known = Json::object();
  for (const auto& [name, value] : first["inputs"].items()) {
    if (!value.is_null()) known[name] = value;
  }
  return values_text(known);
}

/// The details of the first row of a finding.
std::string detail(const std::string& finding, const Json& first, const Json& document) {
  const std::string at = values_text(first["state"]);
  if (is_of_states(finding)) return at;
  if (finding == "off_model") {
    const Json& next = first["next"];
    return fmt::format("from {} with {} the model leads to {} between {:.6g} and {:.6g}, found {:.6g}", at,
                       inputs_text(first), line_of(next["state"]), next["lower"].get<double>(),
                       next["upper"].get<double>(), next["found"].get<double>());
  }
  if (finding == "reckless") {
    std::vector<std::string> names;
    for (const Json& name : first["classes"]) names.push_back(line_of(name));
    std::string unknown;
    for (const Json& name : first["no_values"])
      unknown += fmt::format(", which is no value of {} in the spec", line_of(name));
    return fmt::format("{} at {} with {}{}", fmt::join(names, ", "), at, inputs_text(first), unknown);
  }
  if (finding == "not_coordinated") return fmt::format("at {} with {}", at, inputs_text(first));
  if (first["reason"] == "silent") return fmt::format("at {} the agents go on without contact", at);
  return fmt::format("{} {}, less than the countdown promised", at, delay_text(first, document));
}

std::string finding_label(const std::string& finding) {
  if (finding == "outside") return "outside the domain";
  if (finding == "unsafe") return "not safe";
  if (finding == "off_model") return "off the model";
  return finding == "breach" ? "countdown broken" : label_of(finding);
}

std::string finding_text(const std::string& finding, const Json& entry, const Json& document) {
  if (entry["judged"] == 0) return "not judged";
  const std::string of =
      count_of(number_of(entry["judged"]), is_of_states(finding) || finding == "breach" ? "row" : "step");
  if (entry["count"] == 0) return "in none of " + of;
  const Json& first = entry["first"];
  std::string when = "row " + grouped(first["row"]);
  if (!first["t"].is_null()) when += fmt::format(" (t = {:.6g})", first["t"].get<double>());
  return fmt::format("in {} of {}, first in {}: {}", grouped(entry["count"]), of, when,
                     detail(finding, first, document));
}

std::string flag(std::optional<bool> found) {
  return found ? (*found ? "1" : "0") : "";
}

std::string number(const Rational& value) {
  return fmt::format("{}", nearest_double(value));
}

}  // namespace

JudgeSummary::JudgeSummary(const ResultsReader& results, std::size_t partition)
    : results_(results), partition_(partition), reckless_(results.partitions()[partition].classes.size()) {}

void JudgeSummary::add(const JudgedRow& row) {
  ++rows_;
  if (row.is_after_gap) ++gaps_;
  for (std::size_t c = 0; c < reckless_.size(); ++c) {
    if (row.is_reckless[c].value_or(false)) ++reckless_[c];
  }
  for (const LogFinding finding : kAllLogFindings) {
    const std::optional<bool> found = row.found(finding);
    if (!found) continue;
    Tally& tally = tallies_[static_cast<std::size_t>(finding)];
    ++tally.judged;
    if (*found && tally.count++ == 0) tally.first = row;
  }
}

bool JudgeSummary::holds() const {
  const auto count = [this](LogFinding finding) { return tallies_[static_cast<std::size_t>(finding)].count; };
  return count(LogFinding::off_model) == 0 && count(LogFinding::breach) == 0;
}

Json JudgeSummary::row_json(const JudgedRow& row) const {
  const ProblemSpec& spec = results_.spec();
  Json json = {{"row", row.number}, {"t", Json()}};
  if (row.log.time) json["t"] = nearest_double(*row.log.time);
  json["state"] = Json::object();
  for (std::size_t i = 0; i < spec.states.size(); ++i)
    json["state"][spec.states[i].name] = nearest_double(row.position.state[i]);
  json["inputs"] = Json::object();
  for (std::size_t i = 0; i < spec.inputs.size(); ++i) {
    const std::optional<Rational>& value = row.log.inputs[i];
    json["inputs"][spec.inputs[i].name] = value ? Json(nearest_double(*value)) : Json();
  }
  json["cell"] = row.position.location.cell < 0 ? Json() : Json(row.position.location.cell);
  json["delay"] = delay_json(row.delay);
  json["delay_status"] = delay_label(row.delay);
  json["countdown"] = row.countdown ? delay_json(*row.countdown) : Json();
  json["countdown_status"] = row.countdown ? delay_label(*row.countdown) : "none";
  return json;
}

Json JudgeSummary::first_json(const JudgedRow& row, LogFinding finding) const {
  Json json = row_json(row);
  if (finding == LogFinding::off_model) {
    json["next"] = {{"state", results_.spec().states[row.misfit->state].name},
                    {"found", nearest_double(row.misfit->found)},
                    {"lower", nearest_double(row.misfit->lower)},
                    {"upper", nearest_double(row.misfit->upper)}};
  } else if (finding == LogFinding::reckless) {
    json["classes"] = Json::array();
    for (std::size_t c = 0; c < row.is_reckless.size(); ++c) {
      if (row.is_reckless[c].value_or(false))
        json["classes"].push_back(results_.partitions()[partition_].classes[c]);
    }
    json["no_values"] = Json::array();
    for (const std::size_t i : row.unknown_inputs)
      json["no_values"].push_back(results_.spec().inputs[i].name);
  } else if (finding == LogFinding::breach) {
    json["reason"] = row.tolerates_less ? "tolerates_less" : "silent";
  }
  return json;
}

Json JudgeSummary::json() const {
  const ProblemSpec& spec = results_.spec();
  Json json = {{"name", spec.name},
               {"results", results_.path()},
               {"guarantee", results_.attributes().guarantee},
               {"partition", results_.partitions()[partition_].name},
               {"connection_delay", spec.coordination.connection_delay},
               {"period", nearest_double(spec.dynamics.period)},
               {"period_unit", spec.dynamics.unit},
               {"rows", rows_},
               {"gaps", gaps_}};
  json["findings"] = Json::object();
  for (const LogFinding finding : kAllLogFindings) {
    const Tally& tally = tallies_[static_cast<std::size_t>(finding)];
    Json& entry =
        json["findings"][finding_name(finding)] = {{"judged", tally.judged}, {"count", tally.count}};
    if (finding == LogFinding::reckless) {
      for (std::size_t c = 0; c < reckless_.size(); ++c)
        entry["classes"][results_.partitions()[partition_].classes[c]] = reckless_[c];
    }
    entry["first"] = tally.first ? first_json(*tally.first, finding) : Json();
  }
  json["holds"] = holds();
  return json;
}

std::string judgement_text(const Json& found) {
  std::string text = fmt::format("{}, partition {}: {}", line_of(found["name"]), line_of(found["partition"]),
                                 count_of(number_of(found["rows"]), "row"));
  if (found["gaps"] > 0) text += fmt::format(", {} after missing samples", grouped(found["gaps"]));
  Facts facts;
  for (const auto& [finding, entry] : found["findings"].items())
    facts.emplace_back(finding_label(finding), finding_text(finding, entry, found));
  return text + "\n" + facts_text(facts);
}

std::string judged_csv_header(const ResultsReader& results, std::size_t partition) {
  std::string line = answer_column("row", results) + "," + answer_column("t", results);
  for (const GridDimension& dimension : results.grid().dimensions()) line += "," + dimension.name;
  for (const char* const name : {"cell", "delay", "countdown"}) line += "," + answer_column(name, results);
  for (const LogFinding finding : kAllLogFindings) {
    const std::string name = finding_name(finding);
    if (finding != LogFinding::reckless) {
      line += "," + answer_column(name, results);
      continue;
    }
    for (const std::string& one : results.partitions()[partition].classes) line += "," + name + ":" + one;
  }
  return line + "\n";
}

std::string judged_csv_line(const JudgedRow& row) {
  std::string line = std::to_string(row.number) + ",";
  if (row.log.time) line += number(*row.log.time);
  for (const Rational& value : row.position.state) line += "," + number(value);
  line += "," + (row.position.location.cell < 0 ? "" : std::to_string(row.position.location.cell));
  line += "," + (row.position.cells.empty() ? "" : csv_steps(row.delay));
  line += "," + (row.countdown ? csv_steps(*row.countdown) : "");
  for (const LogFinding finding : kAllLogFindings) {
    if (finding != LogFinding::reckless) line += "," + flag(row.found(finding));
    for (std::size_t c = 0; finding == LogFinding::reckless && c < row.is_reckless.size(); ++c)
      line += "," + flag(row.is_reckless[c]);
  }
  return line + "\n";
}

}  // namespace coordreq
