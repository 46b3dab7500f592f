#include "app/reports.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "answers/plan.hpp"
#include "app/answers/all.hpp"
#include "app/render.hpp"
#include "app/requirement_text.hpp"
#include "base/requires.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Align = Table::Align;

/// "201 x 41 = 8,241", or "201" for a single factor.
std::string product(const std::vector<std::int64_t>& factors, std::int64_t result) {
  if (factors.size() == 1) return grouped(result);
  std::string text;
  for (const std::int64_t factor : factors) text += (text.empty() ? "" : " x ") + grouped(factor);
  return text + " = " + grouped(result);
}

std::string sizes(const Json& summary, const ProblemSpec& spec) {
  std::vector<std::int64_t> points, values;
  for (const StateSpec& state : spec.states) points.push_back(state.grid.count);
  for (const InputSpec& input : spec.inputs) values.push_back(static_cast<std::int64_t>(input.values.size()));
  const auto counted = [](std::int64_t count, const char* what) {
    return std::string(what) + (count == 1 ? "" : "s");
  };
  const std::int64_t all_cells = number_of(summary["cells"]), all_inputs = number_of(summary["joint_inputs"]);
  return fmt::format("{}: {} {}, {} {}\n", text_of(summary["name"]), product(points, all_cells),
                     counted(all_cells, "cell"), product(values, all_inputs),
                     counted(all_inputs, "joint input"));
}

/// In how many cells D steps are more than they can do without, and in how many they are all of it, or more.
std::string connection_text(const Json& partition, const Json& summary) {
  const std::int64_t delay = number_of(summary["connection_delay"]);
  const bool unknown =
      partition["truncated"].get<bool>() && delay >= static_cast<std::int64_t>(partition["layers"].size());
  const Json& layers = partition["layers"];
  const auto next = static_cast<std::size_t>(delay) + 1;
  const std::int64_t longer = next < layers.size()     ? number_of(layers[next])
                              : partition["truncated"] ? 0
                                                       : number_of(layers.back());
  return fmt::format(
      "takes {} to establish: must exist already in {}{}, or be requested at once in {}{} more",
      duration(delay, summary), unknown ? "at most " : "", cells(partition["never_without_connection"]),
      partition["truncated"] && next >= layers.size() ? "at most " : "",
      grouped(static_cast<std::uint64_t>(std::max<std::int64_t>(
          number_of(layers[0]) - number_of(partition["never_without_connection"]) - longer, 0))));
}

/// From where agents that act alone by a policy gain by it.
void add_layers(const AnswerPolicy& policy, const Json& entry, Facts& facts) {
  const Json& layers = entry["layers"];
  facts.emplace_back("  " + policy.label, shortened(layers.get<std::vector<std::int64_t>>()));
  const std::string for_ever = entry["truncated"] ? "an unknown number" : cells(entry["fixed_point"]);
  facts.emplace_back("  " + policy.gain, fmt::format("for one step from {}, indefinitely from {}",
                                                     cells(layers[layers.size() > 1 ? 1 : 0]), for_ever));
}

/// The silence that so many percent of K tolerate at least. @pre there is a finite delay
std::string tolerated(const Json& partition, const Json& summary, int percent) {
  const Json& layers = partition["layers"];
  REQUIRES(layers.size() > 1);
  const std::int64_t kept = number_of(layers[0]);
  std::int64_t steps = 0;
  for (std::size_t k = 1; k < layers.size() && number_of(layers[k]) * 100 >= kept * percent; ++k)
    steps = static_cast<std::int64_t>(k);
  const bool is_last = steps + 1 == static_cast<std::int64_t>(layers.size());
  if (is_last && !partition["truncated"].get<bool>() && number_of(layers.back()) * 100 >= kept * percent)
    return "any number of steps";
  return steps == 0 ? "not one step" : "at least " + duration(steps, summary);
}

void add_shares(const Json& partition, const Json& summary, Facts& facts) {
  if (partition["layers"].size() < 2) return;
  for (const auto& [percent, label] : {std::pair(50, "half"), std::pair(90, "90 %"), std::pair(99, "99 %")})
    facts.emplace_back(fmt::format("  {} of K can tolerate", label), tolerated(partition, summary, percent));
}

/// " All best states lie at the edge of the grid, ...", or nothing.
std::string edge_hint(const Json& partition) {
  std::vector<std::string> sides;
  for (const Json& entry : partition["best_at_edges"])
    sides.push_back(fmt::format("{} = {:.6g}", text_of(entry["state"]), entry["value"].get<double>()));
  if (sides.empty()) return "";
  return fmt::format(
      "  All best states lie at the edge of the grid ({}): a larger domain may tolerate more.\n",
      fmt::join(sides, ", "));
}

/// "873 cells, of these 140 because they leave through a safe side".
std::string unbounded_delay_text(const Json& partition) {
  if (partition["truncated"]) return "unknown";
  const std::int64_t all = number_of(partition["fixed_point"]);
  const Json& leaving = partition["leaving"];
  if (leaving.is_null() || all == 0) return cells(all);
  if (number_of(leaving) == all) return cells(all) + ", because they leave through a safe side";
  return fmt::format("{}, of these {} because they leave through a safe side", cells(all), grouped(leaving));
}

std::string unbounded_cells(const Json& partition) {
  return partition["truncated"] ? "unknown" : cells(partition["fixed_point"]);
}

/// The layers of what the spec asks for come first, then those of independent choice, then others.
std::string partition_text(const Json& partition, const Json& summary, const ProblemSpec& spec) {
  Facts facts;
  const std::string lead = headline_policies(spec).front().name;
  const std::vector<AnswerPolicy> policies = answer_policies(spec);
  for (const AnswerPolicy& policy : policies) {
    if (!lead.empty() && policy.name == lead) add_layers(policy, partition[lead], facts);
  }
  facts.emplace_back("  layers", shortened(partition["layers"].get<std::vector<std::int64_t>>()));
  facts.emplace_back("  fixed point", (partition["truncated"] ? "" : "F = ") + fixed_point_text(partition));
  facts.emplace_back("  unbounded delay", unbounded_delay_text(partition));
  add_shares(partition, summary, facts);
  for (const AnswerPolicy& policy : policies) {
    if (policy.name != lead && partition.contains(policy.name))
      add_layers(policy, partition[policy.name], facts);
  }
  if (number_of(summary["connection_delay"]) > 0)
    facts.emplace_back("  connection", connection_text(partition, summary));
  return fmt::format("\npartition {}\n{}{}{}", text_of(partition["name"]), facts_text(facts),
                     headline_lines(partition, summary, headline_policies(spec)), edge_hint(partition));
}

/// One line a partition.
std::string partitions_table(const Json& summary, const AnswerPolicy& lead) {
  const std::int64_t delay = number_of(summary["connection_delay"]);
  std::vector<Column> columns = {
      {"partition", Align::left, [](const Json& entry) { return text_of(entry["name"]); }},
      {"F", Align::right, fixed_point_text},
      {"unbounded", Align::right, unbounded_cells},
      {"longest finite delay", Align::left,
       [&summary](const Json& entry) { return longest_delay_text(entry, summary); }}};
  if (!lead.name.empty()) {
    columns.insert(columns.begin() + 1,
                   {lead.gain + " indefinitely", Align::right,
                    [&lead](const Json& entry) { return unbounded_cells(entry[lead.name]); }});
  }
  if (delay > 0) {
    columns.push_back({"never without connection", Align::right,
                       [](const Json& entry) { return cells(entry["never_without_connection"]); }});
  }
  const std::string connection =
      delay > 0 ? fmt::format("A connection takes {} to establish.\n", duration(delay, summary)) : "";
  return "\n" + table_text(summary["partitions"], columns) + connection;
}

std::string sets_text(const Json& summary, const ProblemSpec& spec) {
  Facts facts;
  if (summary.contains("controller")) {
    const Json& controller = summary["controller"];
    facts.emplace_back("controller",
                       fmt::format("{} of {} pairs, from {}", grouped(controller["pairs"]),
                                   grouped(number_of(summary["cells"]) * number_of(summary["joint_inputs"])),
                                   line_of(controller["file"])));
  }
  facts.emplace_back("safe set", cells(summary["safe"]));
  facts.emplace_back("invariance set", fmt::format("{} after {}", cells(summary["invariant"]),
                                                   count_of(number_of(summary["iterations"]), "sweep")));
  for (const AddFacts add : analysis_facts()) add(summary, facts);
  facts.emplace_back("guarantee", guarantee_line(text_of(summary["guarantee"]), summary["motion"], spec));
  const Json& tightness = summary["tightness"];
  if (!tightness.is_null() && number_of(tightness["p99"]) > 1) {
    facts.emplace_back(
        "tightness",
        fmt::format(
            "{:.1f} % of sampled successor sets are more than a cell wider than solutions, at most {}",
            100 * tightness["share"].get<double>(), cells(tightness["most"])));
  }
  return facts_text(facts);
}

std::string partitions_text(const Json& summary, const ProblemSpec& spec) {
  if (summary["safe"] == 0) return "\nThe safe set is empty: no cell satisfies \"safe\".\n";
  if (summary["invariant"] == 0 && spec.controller.synthesis == Synthesis::given) {
    return "\nThe invariance set is empty on this grid: there is no state from which every allowed action "
           "keeps the "
           "system "
           "safe.\n";
  }
  if (summary["invariant"] == 0) {
    return "\nThe invariance set is empty on this grid: no state can be kept safe, even if all agents always "
           "coordinate.\n";
  }
  if (!has_partitions_in_full(summary)) return partitions_table(summary, headline_policies(spec).front());
  std::string text;
  for (const Json& partition : summary["partitions"]) text += partition_text(partition, summary, spec);
  return text;
}

std::string closing_text(const Json& summary) {
  const std::int64_t threads = number_of(summary["threads"]);
  const std::string output = summary["output"].is_null() ? "" : line_of(summary["output"]);
  return fmt::format("\nresults in {} ({:.2f} s on {} thread{}, {})\n", output, seconds_of(summary), threads,
                     threads == 1 ? "" : "s", byte_size(summary["peak_memory_bytes"].get<std::uint64_t>()));
}

}  // namespace

std::string summary_text(const Json& summary, const ProblemSpec& spec) {
  std::string text = sizes(summary, spec) + sets_text(summary, spec) + partitions_text(summary, spec);
  for (const AnalysisSection section : analysis_sections()) text += section(summary, spec);
  std::vector<std::string> known = {"controller", "seconds", "work", "tightness", "warnings"};
  known.insert(known.end(), known_members().begin(), known_members().end());
  return text + others_text(summary, known) + requirements_text(summary["requirements"], spec) +
         closing_text(summary);
}

bool has_partitions_in_full(const Json& summary) {
  return summary["safe"] != 0 && summary["invariant"] != 0 &&
         summary["partitions"].size() <= kMostPartitionsInFull;
}

std::string fixed_point_text(const Json& partition) {
  return partition["truncated"] ? "not reached" : std::to_string(number_of(partition["F"]));
}

std::string unbounded_text(const Json& partition) {
  return partition["truncated"] ? "unknown" : grouped(partition["fixed_point"]);
}

std::string longest_delay_text(const Json& partition, const Json& summary) {
  const auto last = static_cast<std::int64_t>(partition["layers"].size()) - 1;
  if (partition["truncated"]) return "at least " + duration(last, summary);
  return last == 0 ? "" : duration(last - 1, summary);
}

double seconds_of(const Json& summary) {
  double seconds = 0;
  for (const Json& stage : summary["seconds"]) seconds += stage.get<double>();
  return seconds;
}

}  // namespace coordreq
