#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/all.hpp"
#include "app/network_report.hpp"
#include "app/print_answer.hpp"
#include "app/render.hpp"
#include "app/requirement_text.hpp"
#include "results/read_info.hpp"

namespace coordreq {
namespace {

using Align = Table::Align;

std::string head_text(const Json& info) {
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
       {"guarantee", guarantee_text(text_of(info["guarantee"]))},
       {"cells", grouped(info["cells"])},
       {"safe set", grouped(info["safe"])},
       {"invariance set", grouped(info["invariant"])}});
  if (info.contains("goal")) {
    const Json& goal = info["goal"];
    facts.emplace_back("goal", grouped(goal["cells"]));
    facts.emplace_back("goal can be forced", grouped(goal["winning"]));
    if (!goal["longest_arrival"].is_null())
      facts.emplace_back("longest way to it", duration(goal["longest_arrival"], info));
  }
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
  return table_text(partitions,
                    {{"partition", Align::left, [](const Json& own) { return line_of(own["name"]); }},
                     {"F", Align::right,
                      [](const Json& own) { return own["truncated"] ? "not reached" : own["F"].dump(); }},
                     {"layers", Align::left, [](const Json& own) {
                        return shortened(own["layers"].get<std::vector<std::int64_t>>());
                      }}});
}

/// How many cells are given which partition, and where pairs are critical, as far as there are any.
std::string coalition_text(const Json& info) {
  const Json& coalition = info["coalition"];
  if (coalition.is_null()) return "";
  Table table({Align::left, Align::right});
  const auto add = [&table](const std::string& name, const Json& count) {
    if (!count.is_null() && count > 0) table.add({name, cells(count)});
  };
  for (const Json& own : coalition["partitions"]) add("  " + line_of(own["name"]), own["cells"]);
  add("  none suffices", coalition["no_partition_suffices"]);
  for (const Json& own : coalition["critical_pairs"])
    add("  critical pair " + line_of(own["name"]), own["cells"]);
  return fmt::format("\ncoalitions for {}\n{}", duration(coalition["horizon"], info), table.text());
}

std::string requirements_text(const Json& info) {
  const auto least = [&info](const Json& own) {
    const std::string key = worst_key(own);
    const Json& status = own[key + "_status"];
    return status == "steps" ? duration(own[key], info) : text_of(status);
  };
  const auto story = [&info](const Json& own) {
    const Json& steps = own["counterexample_steps"];
    return !steps.is_null() ? duration(steps, info) : own["holds"] ? "-" : "outside the domain";
  };
  if (info["requirements"].empty()) return "";
  return "\n" +
         table_text(
             info["requirements"],
             {{"requirement", Align::left, [](const Json& own) { return line_of(own["name"]); }},
              {"verdict", Align::left, [](const Json& own) { return own["holds"] ? "holds" : "FAILS"; }},
              {"cells", Align::right, [](const Json& own) { return grouped(own["cells"]); }},
              {"failing", Align::right, [](const Json& own) { return grouped(own["failing"]); }},
              {info.contains("goal") ? "worst" : "least delay", Align::left, least},
              {"counterexample", Align::right, story}});
}

std::string info_text(const Json& info) {
  std::string text = head_text(info) + "\n" + axes_text(info) + "\n" +
                     described_partitions(info["partitions"]) + coalition_text(info) +
                     requirements_text(info);
  if (info.contains("modes")) text += "\n" + modes_text(info["modes"]);
  text += others_text(info, {"coalition", "goal"});
  text += "\ndatasets\n";
  for (const Json& dataset : info["datasets"]) text += "  " + line_of(dataset) + "\n";
  return text;
}

struct InfoOptions : CommonOptions {
  std::string results;
};

}  // namespace

Run declare_info(Options& options) {
  const auto own = std::make_shared<InfoOptions>();
  declare_results(options, own->results);
  declare_common(options, *own, {.threads = false});
  return [own] {
    own->keep_to_memory();
    print_answer(*own, read_info(own->results, own->max_memory), info_text);
    return ExitCode::success;
  };
}

}  // namespace coordreq
