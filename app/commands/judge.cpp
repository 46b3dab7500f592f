#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/all.hpp"
#include "app/ignored_columns.hpp"
#include "app/judge_report.hpp"
#include "app/option_values.hpp"
#include "app/print_answer.hpp"
#include "app/standard_streams.hpp"
#include "cell/log_judge.hpp"
#include "cell/simulate.hpp"
#include "results/results_reader.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

struct JudgeOptions : CommonOptions {
  std::string results;
  std::string partition;
  bool csv = false;  ///< a line for each row instead of the summary
};

ExitCode run(const JudgeOptions& options) {
  if (options.csv && options.json) throw UsageError("expected --csv or --json, found both", "--csv");
  options.keep_to_memory();
  const ResultsReader results(options.results, options.max_memory);
  const std::size_t partition = find_partition(results.spec(), options.partition);
  ThreadTeam team(options.threads_for("judging needs", controller_demand(results, true)));
  LogReader log(std::cin, results.spec(), "standard input");
  IgnoredColumns ignored(options.quiet, "no state or input");
  ignored.tell(log.unknown_names(), "");
  LogJudge judge(results, partition, log, team);
  JudgeSummary summary(results, partition);
  if (options.csv) write_output(judged_csv_header(results, partition));
  while (const std::optional<JudgedRow> row = judge.next()) {
    ignored.tell(log.unknown_names(), "");
    summary.add(*row);
    if (options.csv) write_output(judged_csv_line(*row));
  }
  if (summary.rows() == 0)
    throw UsageError("no samples, expected a line of column names and a line for each", "standard input");
  if (!options.csv) print_answer(options, summary.json(), judgement_text);
  return summary.holds() ? ExitCode::success : ExitCode::requirement_failed;
}

}  // namespace

Run declare_judge(Options& options) {
  const auto own = std::make_shared<JudgeOptions>();
  declare_results(options, own->results);
  options.option(own->partition, "--partition", "NAME", "Partition (default: the only one)", as_typed);
  options.flag(own->csv, "--csv", "A line for each row, as CSV, instead of the summary");
  declare_common(options, *own);
  return [own] { return run(*own); };
}

}  // namespace coordreq
