#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "app/answers/all.hpp"
#include "app/atomic_file.hpp"
#include "app/commands/all.hpp"
#include "app/files_in_use.hpp"
#include "app/option_values.hpp"
#include "app/print.hpp"
#include "app/report_html.hpp"
#include "app/report_text.hpp"
#include "app/text.hpp"
#include "base/json.hpp"
#include "export/report_data.hpp"
#include "export/report_page.hpp"
#include "results/results_reader.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// The partitions whose delay can be looked at: as many as a page has room for, those first with the most
/// classes, where silence matters most.
std::vector<std::size_t> displayed_partitions(const ResultsReader& results) {
  const auto& partitions = results.partitions();
  std::vector<std::size_t> order(partitions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t most = ReportLimits().partitions;
  if (order.size() <= most) return order;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return partitions[a].classes.size() > partitions[b].classes.size();
  });
  order.resize(most);
  std::sort(order.begin(), order.end());
  return order;
}

std::string page_of(const ResultsReader& results, ReportData& data) {
  data = report_data(results, displayed_partitions(results));
  ReportPage page;
  page.title = printable(report_title(results.spec()));
  page.summary = "<h1>" + html_line(report_title(results.spec())) + "</h1>\n" + report_task(results);
  // What fails comes first.
  const bool is_failing = has_failed_requirement(results);
  if (is_failing) page.summary += report_requirements(results);
  page.summary += report_answer(results, data);
  for (const ReportSection section : report_sections())
    if (!is_failing || section != report_requirements) page.summary += section(results);
  page.details = report_details(results) + report_footer(results);
  page.data = std::move(data.json);
  return report_page(page);
}

Json summary_json(const std::string& path, std::size_t bytes, const ReportData& data,
                  const ResultsReader& results) {
  Json json;
  json["output"] = path;
  json["bytes"] = bytes;
  json["every_cell"] = data.is_whole;
  json["partitions"] = Json::array();
  for (const std::size_t p : data.partitions) json["partitions"].push_back(results.partitions()[p].name);
  return json;
}

/// @param partitions of the results
std::string summary_text(const Json& summary, std::size_t partitions) {
  std::string text = fmt::format("report in {} ({})\n", printable(summary["output"].get<std::string>()),
                                 byte_size(summary["bytes"].get<std::uint64_t>()));
  if (!summary["every_cell"].get<bool>())
    text += "it does not hold every cell: the sliders have some values only\n";
  if (summary["partitions"].size() < partitions)
    text += fmt::format("its pictures show {} of {} partitions\n", summary["partitions"].size(), partitions);
  return text;
}

struct ReportOptions : CommonOptions {
  std::string results;
  std::optional<std::string> output;
  bool is_forced = false;
};

ExitCode run(const ReportOptions& options) {
  options.keep_to_memory();
  const ResultsReader results(options.results, options.max_memory);
  static_cast<void>(options.threads_for("a report needs", {.once = report_bytes(results)}));
  const std::string path = options.output.value_or(results.spec().name + ".html");
  check_output(options.results, path, "the report");
  if (!options.output && !options.is_forced)
    check_replaces_own_report(path, results.attributes().spec_sha256);
  AtomicFile file(path, "the report");
  ReportData data;
  const std::string page = page_of(results, data);
  file.write(page);
  file.commit();
  print_answer(options, summary_json(path, page.size(), data, results), [&results](const Json& summary) {
    return summary_text(summary, results.partitions().size());
  });
  return ExitCode::success;
}

}  // namespace

Run declare_report(Options& options) {
  const auto args = std::make_shared<ReportOptions>();
  declare_results(options, args->results);
  options.option(args->output, "-o,--output", "FILE", "HTML file (default: NAME.html in the current folder)",
                 file_name);
  options.flag(args->is_forced, "--force",
               "Replace a file of the name NAME.html also if it is no report on these results");
  declare_common(options, *args, {.threads = false});
  return [args] { return run(*args); };
}

}  // namespace coordreq
