#include <fmt/format.h>

#include <algorithm>

#include "answers/paths.hpp"
#include "app/query_report.hpp"
#include "app/render.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Columns after the state that all files have: inside, cell, safe, invariant, collision_time.
constexpr std::size_t kOfAllFiles = 5;

/// A number with all digits of a probability: a rounded one could be less than it.
std::string csv_number(const Field& field, std::int32_t value) {
  return field.kind == FieldKind::probability ? fmt::format("{}", probability_of(value)) : csv_steps(value);
}

std::string csv_actions(const std::vector<bool>& actions) {
  std::string text;
  for (std::size_t a = 0; a < actions.size(); ++a) {
    if (actions[a]) text += (text.empty() ? "" : " ") + std::to_string(a);
  }
  return text;
}

std::string csv_actions(const ActionSets& sets) {
  std::string text;
  for (const std::vector<bool>& actions : sets) text += "," + csv_actions(actions);
  return text;
}

/// A number, one for each entry, or the names of the entries that hold.
std::string csv_section(const Field& field, const std::vector<std::int32_t>& values,
                        const ResultsReader& results) {
  if (field.kind == FieldKind::choice) return std::to_string(values.front());
  if (field.kind == FieldKind::probability) {
    std::string text;
    for (const std::int32_t value : values) text += (text.empty() ? "" : ",") + csv_number(field, value);
    return text;
  }
  std::string names;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] != 0) names += (names.empty() ? "" : " ") + results.leading_names(field)[i];
  }
  return names;
}

std::string csv_partition_header(const StoredPartition& partition, const QueryForm& form) {
  std::string line;
  for (const AnswerPolicy& policy : form.policies) {
    const std::string prefix = policy.name.empty() ? "" : policy.name + "_";
    line += fmt::format(",{}delay:{}", prefix, partition.name);
    if (!policy.trigger.empty()) line += fmt::format(",{}countdown:{}", prefix, partition.name);
    for (const std::string& name : partition.classes)
      line += fmt::format(",{}actions:{}:{}", prefix, partition.name, name);
  }
  for (const Field* const field : form.numbers) {
    if (QueryForm::is_of_partitions(*field))
      line += fmt::format(",{}:{}", field->display.query.name, partition.name);
  }
  return line;
}

std::string csv_partition(const StateAnswer& answer, std::size_t p, const QueryForm& form) {
  std::string line;
  for (const AnswerPolicy& policy : form.policies) {
    line += "," + csv_steps(answer.value(policy.delay, p));
    if (!policy.trigger.empty()) line += "," + csv_steps(answer.value(policy.trigger, p));
    line += csv_actions(answer.actions.at(policy.name)[p]);
  }
  for (const Field* const field : form.numbers) {
    if (QueryForm::is_of_partitions(*field)) line += "," + csv_number(*field, answer.value(field->path, p));
  }
  return line;
}

/// Everything but what stood beside the state.
std::string header_of_answers(const QueryForm& form) {
  const ResultsReader& results = form.results;
  std::string line;
  for (const GridDimension& dimension : results.grid().dimensions()) line += dimension.name + ",";
  line += fmt::format("{},{},safe,invariant,collision_time", answer_column("inside", results),
                      answer_column("cell", results));
  for (const StoredPartition& partition : results.partitions()) line += csv_partition_header(partition, form);
  for (const Field* const field : form.others) {
    const FieldQuery& query = field->display.query;
    if (field->kind == FieldKind::probability) {
      for (const std::string& entry : results.leading_names(*field)) line += "," + query.name + ":" + entry;
    } else {
      line += "," + answer_column(field->kind == FieldKind::choice ? query.group : query.name, results);
    }
  }
  for (const AnswerPolicy& policy : form.of_agents) {
    for (const AgentSpec& agent : form.spec().agents) line += "," + policy.name + ":" + agent.name;
  }
  for (const Field* const field : form.numbers) {
    if (!QueryForm::is_of_partitions(*field)) line += "," + field->display.query.name;
  }
  return line;
}

std::string line_of_answers(const StateAnswer& answer, const QueryForm& form) {
  const ResultsReader& results = form.results;
  std::string line;
  for (const Rational& value : answer.state) line += fmt::format("{},", nearest_double(value));
  if (answer.location.kind != Location::Kind::cell) {
    line += answer.location.kind == Location::Kind::left_safely ? "0,,1,1," : "0,,,,";
    const std::string header = header_of_answers(form);
    const auto columns = static_cast<std::size_t>(std::count(header.begin(), header.end(), ',')) + 1;
    return line + std::string(columns - results.grid().size() - kOfAllFiles, ',');
  }
  line += fmt::format("1,{},{:d},{:d},{}", answer.location.cell, answer.value(paths::kSafe) != 0,
                      answer.value(paths::kInvariant) != 0, csv_steps(answer.value(paths::kCollisionTime)));
  for (std::size_t p = 0; p < results.partitions().size(); ++p) line += csv_partition(answer, p, form);
  for (const Field* const field : form.others)
    line += "," + csv_section(*field, answer.values.at(field->path), results);
  for (const AnswerPolicy& policy : form.of_agents)
    line += csv_actions(answer.actions.at(policy.name).front());
  for (const Field* const field : form.numbers) {
    if (!QueryForm::is_of_partitions(*field)) line += "," + csv_number(*field, answer.value(field->path));
  }
  return line;
}

}  // namespace

std::string answer_csv_header(const QueryForm& form, const std::vector<std::string>& extra) {
  std::string line = header_of_answers(form);
  const std::string used = "," + line + ",";
  for (const std::string& name : extra) {
    const bool is_used = used.find("," + csv_field(name) + ",") != std::string::npos;
    line += "," + csv_field((is_used ? "extra:" : "") + name);
  }
  return line + "\n";
}

std::string answer_csv_line(const StateAnswer& answer, const QueryForm& form,
                            const std::vector<StateReader::Extra>& extra) {
  std::string line = line_of_answers(answer, form);
  for (const StateReader::Extra& column : extra) line += "," + csv_field(column.value);
  return line + "\n";
}

}  // namespace coordreq
