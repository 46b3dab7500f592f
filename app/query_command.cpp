#include <iostream>
#include <optional>

#include "app/commands.hpp"
#include "app/query_report.hpp"
#include "app/standard_streams.hpp"
#include "cell/state_query.hpp"
#include "cell/state_reader.hpp"
#include "cell/state_text.hpp"
#include "results/results_reader.hpp"

namespace coordreq {
namespace {

std::vector<std::string> state_names(const ResultsReader& results) {
  std::vector<std::string> names;
  for (const GridDimension& dimension : results.grid().dimensions()) names.push_back(dimension.name);
  return names;
}

/// Line by line, so that a program at the other end of two pipes gets each answer before it asks on.
void answer_standard_input(const ResultsReader& results, StateQuery& query, bool as_json) {
  StateReader states(std::cin, state_names(results), "standard input");
  const bool json = as_json || states.format() == StateReader::Format::json_lines;
  if (!json) write_output(answer_csv_header(results));
  while (std::optional<std::vector<Rational>> state = states.next()) {
    const StateAnswer answer = query.at(std::move(*state));
    write_output(json ? answer_json_line(answer, results) : answer_csv_line(answer, results));
  }
}

}  // namespace

ExitCode run_query(const CommandLine& line) {
  const ResultsReader results(line.path, line.max_memory);
  ThreadTeam team(line.threads);
  StateQuery query(results, team);
  if (!line.at) {
    answer_standard_input(results, query, line.json);
    return ExitCode::success;
  }
  const StateAnswer answer = query.at(parse_state(*line.at, state_names(results), "--at"));
  if (line.json) {
    write_output(answer_json(answer, results));
  } else if (!line.quiet) {
    write_output(answer_text(answer, results));
  }
  return ExitCode::success;
}

}  // namespace coordreq
