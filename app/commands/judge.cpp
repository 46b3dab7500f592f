#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>

#include "app/commands/all.hpp"
#include "app/judge_report.hpp"
#include "app/option_values.hpp"
#include "app/print.hpp"
#include "app/standard_streams.hpp"
#include "cell/log_judge.hpp"
#include "cell/simulate.hpp"
#include "results/results_reader.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

struct JudgeOptions : CommonOptions {
  std::string results;
  std::string log;  ///< empty or "-": standard input
  std::string partition;
  bool csv = false;  ///< a line for each row instead of the summary
};

/// The rows to judge, from a file or from standard input.
class LogSource {
 public:
  /// @throws IoError
  explicit LogSource(const std::string& path) : is_file_(!path.empty() && path != "-"), name_(path) {
    if (!is_file_) {
      name_ = "standard input";
      return;
    }
    if (std::filesystem::is_directory(path)) throw IoError("is a folder, expected a log", path);
    file_.open(path);
    if (!file_) throw IoError("cannot be read: " + std::generic_category().message(errno), path);
  }

  [[nodiscard]] std::istream& stream() { return is_file_ ? file_ : std::cin; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  bool is_file_;
  std::string name_;
  std::ifstream file_;
};

ExitCode run(const JudgeOptions& options) {
  if (options.csv && options.json) throw UsageError("expected --csv or --json, found both", "--csv");
  options.keep_to_memory();
  const ResultsReader results(options.results, options.max_memory);
  const std::size_t partition = find_partition(results.spec(), options.partition);
  ThreadTeam team(options.threads_for("judging needs", controller_demand(results, true)));
  LogSource source(options.log);
  LogReader log(source.stream(), results.spec(), source.name());
  IgnoredColumns ignored(options.quiet, "no state or input", source.name());
  ignored.warn(log.unknown_names(), "");
  LogJudge judge(results, partition, log, team);
  JudgeSummary summary(results, partition);
  if (options.csv) write_output(judged_csv_header(results, partition));
  while (const std::optional<JudgedRow> row = judge.next()) {
    ignored.warn(log.unknown_names(), "");
    summary.add(*row);
    if (options.csv) write_output(judged_csv_line(*row));
  }
  if (summary.rows() == 0)
    throw UsageError("no samples, expected a line of column names and a line for each", source.name());
  if (!options.csv) print_answer(options, summary.json(), judgement_text);
  return summary.holds() ? ExitCode::success : ExitCode::requirement_failed;
}

}  // namespace

Run declare_judge(Options& options) {
  const auto args = std::make_shared<JudgeOptions>();
  declare_results(options, args->results);
  options.optional_argument(args->log, "LOG", "The log, CSV or JSON lines (default, and -: standard input)",
                            "FILE");
  options.option(args->partition, "--partition", "NAME", "Partition (default: the only one)", as_typed);
  options.flag(args->csv, "--csv", "Print one line per row, as CSV, instead of the summary");
  declare_common(options, *args);
  return [args] { return run(*args); };
}

}  // namespace coordreq
