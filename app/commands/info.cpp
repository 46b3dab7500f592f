#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "answers/plan.hpp"
#include "app/answers/all.hpp"
#include "app/commands/all.hpp"
#include "app/print.hpp"
#include "app/render.hpp"
#include "app/reports.hpp"
#include "base/json.hpp"
#include "results/read_info.hpp"
#include "results/results_reader.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Align = Table::Align;

std::string head_text(const Json& info, const ProblemSpec& spec) {
  Facts facts = {{"name", line_of(info["name"])},
                 {"written by", fmt::format("coordreq {} ({})", line_of(info["coordreq_version"]),
                                            line_of(info["git_sha1"]))},
                 {"spec SHA-256", line_of(info["spec_sha256"])}};
  if (info.contains("controller_sha256"))
    facts.emplace_back("controller SHA-256", line_of(info["controller_sha256"]));
  facts.insert(
      facts.end(),
      {{"period", fmt::format("{:.6g} {}", info["period"].get<double>(), line_of(info["period_unit"]))},
       {"connection delay", duration(info["connection_delay"], info)},
       {"guarantee", guarantee_of_file(text_of(info["guarantee"]), spec)},
       {"cells", grouped(info["cells"])},
       {"safe set", grouped(info["safe"])},
       {"invariance set", grouped(info["invariant"])}});
  for (const auto add : info_facts()) add(info, facts);
  return facts_text(facts);
}

std::string axes_text(const Json& info) {
  Table table({Align::left, Align::left, Align::right, Align::right, Align::right, Align::left, Align::left});
  table.add({"axis", "kind", "points", "first", "last", "unit", "outside"});
  for (const auto& [list, kind] : {std::pair("states", "state"), std::pair("inputs", "input")}) {
    for (const Json& axis : info[list]) {
      table.add({line_of(axis["name"]), kind, grouped(axis["points"]),
                 fmt::format("{:.6g}", axis["first"].get<double>()),
                 fmt::format("{:.6g}", axis["last"].get<double>()), line_of(axis["unit"]),
                 axis.contains("outside") ? sides_text(axis["outside"]) : ""});
    }
  }
  return table.text();
}

std::string described_partitions(const Json& partitions) {
  return table_text(
      partitions,
      {{"partition", Align::left, [](const Json& entry) { return line_of(entry["name"]); }},
       {"F", Align::right,
        [](const Json& entry) { return entry["truncated"] ? "not reached" : compact_json(entry["F"]); }},
       {"layers", Align::left,
        [](const Json& entry) { return shortened(entry["layers"].get<std::vector<std::int64_t>>()); }}});
}

/// For how long silence is safe, by partition.
std::string answers_text(const Json& info, const std::vector<AnswerPolicy>& policies) {
  const Json& partitions = info["partitions"];
  if (info["invariant"] == 0 || partitions.size() > kMostPartitionsInFull) return "";
  std::string text;
  for (const Json& partition : partitions)
    text += "\n" + line_of(partition["name"]) + "\n" + headline_lines(partition, info, policies);
  return text;
}

std::string info_text(const Json& info, const ProblemSpec& spec) {
  std::string text = head_text(info, spec) + answers_text(info, headline_policies(spec)) + "\n" +
                     axes_text(info) + "\n" + described_partitions(info["partitions"]);
  for (const InfoSection section : info_sections()) text += section(info);
  std::vector<std::string> known = known_members();
  known.emplace_back("spec");
  text += others_text(info, known);
  text += "\ndatasets\n";
  for (const Json& dataset : info["datasets"]) text += "  " + line_of(dataset) + "\n";
  return text;
}

struct InfoOptions : CommonOptions {
  std::string results;
};

}  // namespace

Run declare_info(Options& options) {
  const auto args = std::make_shared<InfoOptions>();
  declare_results(options, args->results);
  declare_common(options, *args, {.threads = false});
  return [args] {
    args->keep_to_memory();
    const ResultsReader results(args->results, args->max_memory);
    print_answer(*args, read_info(results),
                 [&](const Json& info) { return info_text(info, results.spec()); });
    return ExitCode::success;
  };
}

}  // namespace coordreq
