#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/commands/all.hpp"
#include "app/option_values.hpp"
#include "app/print.hpp"
#include "app/query_report.hpp"
#include "app/reports.hpp"
#include "app/standard_streams.hpp"
#include "cell/least_steps.hpp"
#include "cell/simulate.hpp"
#include "cell/state_query.hpp"
#include "cell/state_reader.hpp"
#include "cell/state_text.hpp"
#include "results/results_reader.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Extras = std::vector<StateReader::Extra>;

struct QueryOptions : CommonOptions {
  std::string results;
  std::optional<std::string> at;  ///< none: states come from standard input
  bool extra = false;             ///< what names no state is passed through
  bool least = false;             ///< standard input has pairs of a fleet
  std::optional<std::string> at_least;
  std::string partition;
};

/// The query about pairs of a fleet.
constexpr const char* kSilence = "/silence";

/// Line by line, so that a program at the other end of two pipes gets each answer before it asks on.
void answer_standard_input(const QueryOptions& options, const ResultsReader& results, StateQuery& query) {
  const QueryForm form(results);
  StateReader states(std::cin, state_names(results.spec()), "standard input");
  const bool json = options.json || states.format() == StateReader::Format::json_lines;
  IgnoredColumns ignored(options.quiet || options.extra, "no state");
  constexpr const char* kHint = "; --extra passes it through";
  ignored.warn(states.extra_names(), kHint);
  if (!json)
    write_output(answer_csv_header(form, options.extra ? states.extra_names() : std::vector<std::string>()));
  while (std::optional<std::vector<Rational>> state = states.next()) {
    ignored.warn(states.extra_names(), kHint);
    const StateAnswer answer = query.at(std::move(*state));
    write_output(json ? answer_json_line(answer, form, options.extra ? &states.extra() : nullptr)
                      : answer_csv_line(answer, form, options.extra ? states.extra() : Extras()));
  }
}

void check_least(const QueryOptions& options) {
  if (options.least && options.at) throw UsageError("expected --at or --least, found both", "--least");
  if (options.least && options.extra)
    throw UsageError("one answer for all pairs, expected no --extra", "--extra");
  if (!options.least && options.at_least) throw UsageError("expected --least with it", "--at-least");
  if (!options.least && !options.partition.empty())
    throw UsageError("all partitions are shown, expected it with --least only", "--partition");
}

ExitCode answer_least(const QueryOptions& options, const ResultsReader& results) {
  if (!results.has(kSilence))
    throw UsageError("the results have no silence, expected those of a spec with the key 'silence'",
                     "--least");
  const Field& field = results.field(kSilence);
  const std::size_t partition = find_partition(results.spec(), options.partition);
  IgnoredColumns ignored(options.quiet, "no state");
  std::optional<std::int32_t> at_least;
  if (options.at_least) {
    at_least = static_cast<std::int32_t>(
        steps_or_time(*options.at_least, results.spec().dynamics, "--at-least", {.least = 0}));
  }
  const LeastSteps found =
      least_steps(results, field, partition, std::cin, "standard input", at_least,
                  [&ignored](const std::vector<std::string>& names) { ignored.warn(names, ""); });
  print_answer(options, least_json(found, field, partition, at_least, results),
               [&](const Json& json) { return least_text(json, field); });
  return found.below.value_or(0) > 0 ? ExitCode::requirement_failed : ExitCode::success;
}

ExitCode run(const QueryOptions& options) {
  check_least(options);
  options.keep_to_memory();
  const ResultsReader results(options.results, options.max_memory);
  if (options.least) return answer_least(options, results);
  ThreadTeam team(options.threads_for("answering needs", controller_demand(results, !options.at)));
  StateQuery query(results, team);
  if (!options.at) {
    answer_standard_input(options, results, query);
    return ExitCode::success;
  }
  const StateAnswer answer = query.at(parse_state(*options.at, state_names(results.spec()), "--at"));
  print_state(options, answer, QueryForm(results));
  return ExitCode::success;
}

}  // namespace

Run declare_query(Options& options) {
  const auto args = std::make_shared<QueryOptions>();
  declare_results(options, args->results);
  options.option(args->at, "--at", "STATE",
                 "The state, e.g. x1=0.1,x2=1/3 (default: many from standard input, CSV or JSON lines)",
                 as_typed);
  options.flag(args->extra, "--extra",
               "Pass columns (JSON lines: keys) that name no state through to the answers");
  options.flag(args->least, "--least",
               "Minimum silence over the pairs of a fleet on standard input; a column pair is a label");
  options.option(
      args->at_least, "--at-least", "N",
      "With --least: count the pairs below N steps, or a time, e.g. 2s; exit code 1 if there are any",
      as_typed);
  options.option(args->partition, "--partition", "NAME", "With --least: partition (default: the only one)",
                 as_typed);
  declare_common(options, *args);
  return [args] { return run(*args); };
}

}  // namespace coordreq
