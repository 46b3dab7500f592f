#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/all.hpp"
#include "app/option_values.hpp"
#include "app/print.hpp"
#include "app/reports.hpp"
#include "cell/simulate.hpp"
#include "cell/state_text.hpp"
#include "results/results_reader.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

struct ExplainOptions : CommonOptions {
  std::string results;
  std::string at;
  std::string partition;
};

ExitCode run(const ExplainOptions& options) {
  if (options.at.empty()) throw UsageError("no state, expected --at NAME=VALUE,...");
  options.keep_to_memory();
  const ResultsReader results(options.results, options.max_memory);
  const std::size_t partition = find_partition(results.spec(), options.partition);
  const std::vector<Rational> state = parse_state(options.at, state_names(results.spec()), "--at");
  const Location location = locate(results.grid(), state);
  if (location.kind != Location::Kind::cell)
    throw UsageError("expected a state in a cell of the grid, found one outside; see query", "--at");
  ThreadTeam team(options.threads_for("explaining needs", explain_demand(results, partition, location.cell)));
  const DelayExplanation found = explain_delay(results, partition, location.cell, state, team);
  print_answer(options, explanation_json(found, state, location.cell, partition, results),
               [&](const Json& json) { return explanation_text(json, results.spec()); });
  return ExitCode::success;
}

}  // namespace

Run declare_explain(Options& options) {
  const auto args = std::make_shared<ExplainOptions>();
  declare_results(options, args->results);
  options.option(args->at, "--at", "STATE", "The state, e.g. x1=0.1,x2=1/3", as_typed);
  options.option(args->partition, "--partition", "NAME", "Partition (default: the only one)", as_typed);
  declare_common(options, *args);
  return [args] { return run(*args); };
}

}  // namespace coordreq
