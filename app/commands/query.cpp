#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "app/commands/all.hpp"
#include "app/option_values.hpp"
#include "app/query_report.hpp"
#include "app/standard_streams.hpp"
#include "cell/state_query.hpp"
#include "cell/state_reader.hpp"
#include "cell/state_text.hpp"
#include "results/results_reader.hpp"
#include "spec/problem_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Extras = std::vector<StateReader::Extra>;

struct QueryOptions : CommonOptions {
  std::string results;
  std::optional<std::string> at;  ///< none: states come from standard input
  bool extra = false;             ///< what names no state is passed through
};

/// Once; that a log holds more is no defect, but a slip in a name would be.
class IgnoredExtra {
 public:
  explicit IgnoredExtra(const QueryOptions& own) : is_told_(own.quiet || own.extra) {}

  void tell(const StateReader& states) {
    if (is_told_ || states.extra_names().empty()) return;
    is_told_ = true;
    std::string names;
    for (const std::string& name : states.extra_names())
      names += (names.empty() ? "" : ", ") + quote_text(name);
    write_diagnostics(fmt::format(
        "coordreq: warning: no state is called {}: ignored; --extra passes it through (standard input)\n",
        names));
  }

 private:
  bool is_told_;
};

/// Line by line, so that a program at the other end of two pipes gets each answer before it asks on.
void answer_standard_input(const QueryOptions& own, const ResultsReader& results, StateQuery& query) {
  const QueryForm form(results);
  StateReader states(std::cin, state_names(results.spec()), "standard input");
  const bool json = own.json || states.format() == StateReader::Format::json_lines;
  IgnoredExtra ignored(own);
  ignored.tell(states);
  if (!json)
    write_output(answer_csv_header(form, own.extra ? states.extra_names() : std::vector<std::string>()));
  while (std::optional<std::vector<Rational>> state = states.next()) {
    ignored.tell(states);
    const StateAnswer answer = query.at(std::move(*state));
    write_output(json ? answer_json_line(answer, form, own.extra ? &states.extra() : nullptr)
                      : answer_csv_line(answer, form, own.extra ? states.extra() : Extras()));
  }
}

ExitCode run(const QueryOptions& own) {
  own.keep_to_memory();
  const ResultsReader results(own.results, own.max_memory);
  ThreadTeam team(own.threads_for("answering needs", controller_demand(results, !own.at)));
  StateQuery query(results, team);
  if (!own.at) {
    answer_standard_input(own, results, query);
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
  options.flag(own->extra, "--extra",
               "Pass columns (JSON lines: keys) that name no state of standard input through to the answers");
  declare_common(options, *own);
  return [own] { return run(*own); };
}

}  // namespace coordreq
