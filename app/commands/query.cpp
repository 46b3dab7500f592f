#include <iostream>
#include <memory>
#include <optional>

#include "app/commands/all.hpp"
#include "app/option_values.hpp"
#include "app/query_report.hpp"
#include "app/standard_streams.hpp"
#include "cell/state_query.hpp"
#include "cell/state_reader.hpp"
#include "cell/state_text.hpp"
#include "results/results_reader.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

struct QueryOptions : CommonOptions {
  std::string results;
  std::optional<std::string> at;  ///< none: states come from standard input
};

/// Line by line, so that a program at the other end of two pipes gets each answer before it asks on.
void answer_standard_input(const ResultsReader& results, StateQuery& query, bool as_json) {
  const QueryForm form(results);
  StateReader states(std::cin, state_names(results.spec()), "standard input");
  const bool json = as_json || states.format() == StateReader::Format::json_lines;
  if (!json) write_output(answer_csv_header(form));
  while (std::optional<std::vector<Rational>> state = states.next()) {
    const StateAnswer answer = query.at(std::move(*state));
    write_output(json ? answer_json_line(answer, form) : answer_csv_line(answer, form));
  }
}

ExitCode run(const QueryOptions& own) {
  own.keep_to_memory();
  const ResultsReader results(own.results, own.max_memory);
  ThreadTeam team(own.threads);
  StateQuery query(results, team);
  if (!own.at) {
    answer_standard_input(results, query, own.json);
    return ExitCode::success;
  }
  const StateAnswer answer = query.at(parse_state(*own.at, state_names(results.spec()), "--at"));
  print_state(own, answer, QueryForm(results));
  return ExitCode::success;
}

}  // namespace

Run declare_query(Options& options) {
  const auto own = std::make_shared<QueryOptions>();
  declare_results(options, own->results);
  options.option(own->at, "--at", "STATE",
                 "The state, as x1=0.1,x2=1/3 (default: many from standard input, CSV or JSON lines)",
                 as_typed);
  declare_common(options, *own);
  return [own] { return run(*own); };
}

}  // namespace coordreq
