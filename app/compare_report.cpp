#include "app/reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/print.hpp"
#include "app/render.hpp"
#include "cell/state_query.hpp"
#include "numeric/rational.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Align = Table::Align;

/// The two files that are compared, as their reports need them.
struct Files {
  const ResultsReader& before;
  const ResultsReader& after;
};

std::string key_of(const std::string& field) {
  return field == "delay" ? "partitions" : field;
}

Json set_json(const SetComparison& set) {
  return {{"before", set.before}, {"after", set.after}, {"left", set.left}, {"joined", set.joined}};
}

Json change_json(const ValueChange& change, const Field& field, const Files& files) {
  Json json;
  json["cell"] = change.cell;
  json["state"] = Json::object();
  const CellBox box = box_of_cell(files.before.grid(), change.cell);
  for (std::size_t i = 0; i < box.centre.size(); ++i)
    json["state"][files.before.spec().states[i].name] = nearest_double(box.centre[i]);
  json["before"] = value_json(field, change.before);
  json["before_status"] = status_of(field, change.before);
  json["after"] = value_json(field, change.after);
  json["after_status"] = status_of(field, change.after);
  return json;
}

Json values_json(const ValueComparison& comparison, const Files& files) {
  const Field& field = files.after.field("/" + comparison.name);
  Json json;
  if (comparison.entry) {
    json["name"] = files.after.leading_names(field)[comparison.entry->after];
    json["name_before"] = files.before.leading_names(field)[comparison.entry->before];
  }
  json["lost"] = comparison.lost;
  json["left"] = comparison.left;
  json["now_bounded"] = comparison.from_forever;
  json["cut_off"] = comparison.cut_off;
  json["tolerated"] = comparison.tolerated;
  json["gained"] = comparison.gained;
  json["worst"] = Json::array();
  for (const ValueChange& change : comparison.worst)
    json["worst"].push_back(change_json(change, field, files));
  return json;
}

Json file_json(const ResultsReader& file, const std::vector<std::size_t>& partitions,
               const std::vector<std::string>& requirements) {
  Json json;
  json["file"] = file.path();
  json["name"] = file.spec().name;
  json["spec_sha256"] = file.attributes().spec_sha256;
  json["only_partitions"] = Json::array();
  for (const std::size_t p : partitions) json["only_partitions"].push_back(file.partitions()[p].name);
  json["only_requirements"] = requirements;
  return json;
}

/// A field that has been compared, and what was found: of numbers a list, by partition or of one.
struct Compared {
  const Field& field;
  Json found;
};

std::vector<Compared> compared_fields(const Json& comparison, bool sets, const ResultsReader& file) {
  std::vector<Compared> result;
  for (const Field& field : file.fields()) {
    const std::string key = key_of(field.path.substr(1));
    if (field.display.compared.empty() || !comparison.contains(key)) continue;
    const Json& found = comparison[key];
    if (found.contains("joined") == sets)
      result.push_back({field, found.is_array() ? found : Json::array({found})});
  }
  return result;
}

std::string sets_table(const std::vector<Compared>& sets) {
  Table table({Align::left, Align::right, Align::right, Align::right, Align::right});
  table.add({"cells of the", "before", "after", "left", "joined"});
  for (const Compared& set : sets) {
    const Json& entry = set.found.front();
    table.add({set.field.display.compared, grouped(entry["before"]), grouped(entry["after"]),
               grouped(entry["left"]), grouped(entry["joined"])});
  }
  return table.text();
}

/// The name of the leading axis: "partition".
std::string axis_of(const Field& field) {
  return field.axes.front().substr(1);
}

/// "alone", or "alone (was: a|b)"; the label of a field without a leading axis.
std::string name_of(const Json& entry, const Field& field) {
  if (!entry.contains("name")) return field.display.compared;
  const Json& old = entry["name_before"];
  return line_of(entry["name"]) + (entry["name"] == old ? "" : " (was: " + line_of(old) + ")");
}

std::string values_table(const Compared& values, bool tolerant) {
  const Field& field = values.field;
  const auto count = [](const char* key) { return [key](const Json& entry) { return grouped(entry[key]); }; };
  std::vector<Column> columns = {{values.found.front().contains("name") ? axis_of(field) : "", Align::left,
                                  [&field](const Json& entry) { return name_of(entry, field); }},
                                 {"lost " + field.display.compared, Align::right, count("lost")},
                                 {"left the set", Align::right, count("left")},
                                 {"now bounded", Align::right, count("now_bounded")},
                                 {"gained " + field.display.compared, Align::right, count("gained")}};
  if (tolerant) columns.push_back({"tolerated", Align::right, count("tolerated")});
  return table_text(values.found, columns);
}

/// Whether steps of the partition are only known to be at least this.
bool is_lower_bound(const Json& value, const Json& partition, const Field& field, const ResultsReader& file) {
  const auto& all = file.partitions();
  for (std::size_t p = 0; p < all.size(); ++p) {
    if (partition == all[p].name) return value == file.lower_bound(field, p).value_or(-1);
  }
  return false;
}

/// @param partition its name in this file; null if there is none
std::string value_text(const Json& value, const Json& status, const Json& partition, const Field& field,
                       const ResultsReader& file) {
  if (status == "number") return value.is_number_float() ? probability_text(value) : grouped(value);
  if (status == "not_invariant") return "not in the invariance set";
  if (status != "steps") {
    std::string label = text_of(status);
    std::replace(label.begin(), label.end(), '_', ' ');
    return label;
  }
  const DynamicsSpec& dynamics = file.spec().dynamics;
  return (is_lower_bound(value, partition, field, file) ? "at least " : "") +
         duration(number_of(value), nearest_double(dynamics.period), dynamics.unit);
}

/// The cells that have lost most; empty if none has lost anything.
std::string worst_text(const Json& entry, const Field& field, const Files& files) {
  if (entry["worst"].empty()) return "";
  const std::vector<StateSpec>& states = files.before.spec().states;
  std::vector<Column> columns = {
      {"  cell", Align::right, [](const Json& change) { return "  " + grouped(change["cell"]); }}};
  for (const StateSpec& state : states) {
    columns.push_back({column_heading(state.name, state.unit), Align::right, [&state](const Json& change) {
                         return fmt::format("{:.6g}", change["state"][state.name].get<double>());
                       }});
  }
  const bool is_entry = entry.contains("name");
  const auto value = [&field](const std::string& when, const Json& partition, const ResultsReader& file) {
    return [&field, &file, when, partition](const Json& change) {
      return value_text(change[when], change[when + "_status"], partition, field, file);
    };
  };
  columns.push_back(
      {"before", Align::left, value("before", is_entry ? entry["name_before"] : Json(), files.before)});
  columns.push_back({"after", Align::left, value("after", is_entry ? entry["name"] : Json(), files.after)});
  const auto named = static_cast<std::int64_t>(entry["worst"].size());
  const std::string which =
      named < number_of(entry["lost"]) ? fmt::format("the worst {} of ", grouped(named)) : "";
  return fmt::format("\n{}{}: {}{} that lost {}\n{}", is_entry ? axis_of(field) + " " : "",
                     name_of(entry, field), which, cells(entry["lost"]), field.display.compared,
                     table_text(entry["worst"], columns));
}

/// Where analyses stopped at max_delay, what they found is less than the whole truth.
std::string cut_off_text(const Json& count) {
  if (count == 0) return "";
  return fmt::format(
      "  {} of these {} the delay at which max_delay stopped the later analysis: perhaps nothing is lost "
      "there.\n",
      cells(count), count == 1 ? "has" : "have");
}

std::string only_text(const Json& comparison) {
  std::string text;
  const auto add = [&](const char* kind, const std::string& list) {
    for (const char* const which : {"before", "after"}) {
      const Json& file = comparison[which];
      for (const Json& name : file[list])
        text += fmt::format("{} {}: only in {}\n", kind, line_of(name), line_of(file["file"]));
    }
  };
  add("partition", "only_partitions");
  for (const Json& verdict : comparison["verdicts"]) {
    text += fmt::format("requirement {}: {}\n", line_of(verdict["name"]),
                        verdict["after"] ? "failed, now holds" : "held, now FAILS");
  }
  add("requirement", "only_requirements");
  return text.empty() ? "" : "\n" + text;
}

std::string verdict_text(const Json& comparison, const std::vector<Compared>& values) {
  if (!comparison["worse"].get<bool>()) {
    return fmt::format("\nNot worse: no cell has lost {}.\n",
                       comparison["tolerance"] > 0 ? "more delay than is tolerated" : "delay");
  }
  for (const Compared& one : values) {
    for (const Json& entry : one.found) {
      if (entry["lost"] > 0) return fmt::format("\nWorse: cells have lost {}.\n", one.field.display.compared);
    }
  }
  return "\nWorse: a requirement no longer holds.\n";
}

Json comparison_json(const ResultsComparison& comparison, const ResultsReader& before,
                     const ResultsReader& after, const CompareOptions& options) {
  const Files files{before, after};
  Json json;
  json["before"] = file_json(before, comparison.only_before, comparison.requirements_only_before);
  json["after"] = file_json(after, comparison.only_after, comparison.requirements_only_after);
  json["cells"] = before.grid().cells();
  json["tolerance"] = options.tolerance;
  for (const SetComparison& set : comparison.sets) json[set.name] = set_json(set);
  for (const ValueComparison& values : comparison.values) {
    Json& values_of_name = json[key_of(values.name)];
    if (values.entry) {
      values_of_name.push_back(values_json(values, files));
    } else {
      values_of_name = values_json(values, files);
    }
  }
  json["verdicts"] = Json::array();
  for (const VerdictChange& verdict : comparison.verdicts)
    json["verdicts"].push_back(
        Json{{"name", verdict.name}, {"before", !verdict.holds_after}, {"after", verdict.holds_after}});
  json["worse"] = comparison.is_worse();
  return json;
}

std::string comparison_text(const Json& comparison, const ResultsReader& before, const ResultsReader& after) {
  const Files files{before, after};
  const std::vector<Compared> values = compared_fields(comparison, false, after);
  std::string text =
      fmt::format("{} -> {}: {}\n\n{}", printable(before.path()), printable(after.path()),
                  cells(comparison["cells"]), sets_table(compared_fields(comparison, true, after)));
  for (const Compared& one : values) text += "\n" + values_table(one, comparison["tolerance"] > 0);
  for (const Compared& one : values) {
    for (const Json& entry : one.found)
      text += worst_text(entry, one.field, files) + cut_off_text(entry["cut_off"]);
  }
  return text + only_text(comparison) + verdict_text(comparison, values);
}

}  // namespace

void print_comparison(const CommonOptions& args, const ResultsComparison& comparison,
                      const ResultsReader& before, const ResultsReader& after,
                      const CompareOptions& options) {
  print_answer(args, comparison_json(comparison, before, after, options),
               [&](const Json& found) { return comparison_text(found, before, after); });
}

}  // namespace coordreq
