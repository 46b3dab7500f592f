#include "app/analyze_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "app/coalition_report.hpp"
#include "app/network_report.hpp"
#include "app/requirement_report.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

/// With more partitions than this each gets one line.
constexpr std::size_t kMostInFull = 3;

/// "201 x 41 = 8,241", or "201" for a single factor.
std::string product(const std::vector<std::int64_t>& factors, std::int64_t result) {
  if (factors.size() == 1) return grouped(result);
  std::string text;
  for (const std::int64_t factor : factors) text += (text.empty() ? "" : " x ") + grouped(factor);
  return text + " = " + grouped(result);
}

std::string sizes(const AnalysisSummary& summary, const ProblemSpec& spec) {
  std::vector<std::int64_t> points, values;
  for (const StateSpec& state : spec.states) points.push_back(state.grid.count);
  for (const InputSpec& input : spec.inputs) values.push_back(static_cast<std::int64_t>(input.values.size()));
  return fmt::format("{}: {} cells, {} joint inputs\n", summary.name, product(points, summary.states),
                     product(values, summary.inputs));
}

bool is_joint(const std::string& class_name) {
  return class_name.find('+') != std::string::npos;
}

/// One sentence: for how long the classes can do without coordination, within which agents go on
/// coordinating.
std::string meaning(const PartitionSummary& partition, const AnalysisSummary& summary) {
  const auto length = [&summary](std::int64_t steps) {
    return duration(steps, summary.period, summary.period_unit);
  };
  const bool alone = std::none_of(partition.classes.begin(), partition.classes.end(), is_joint);
  const char* const who = alone ? "agents" : "classes";
  const char* const without = alone ? "without coordination" : "without coordination between classes";
  if (partition.truncated) {
    const auto limit = static_cast<std::int64_t>(partition.layers.size()) - 1;
    return fmt::format("Stopped at max_delay: {} {} {} {}, perhaps more.", cells(partition.layers.back()),
                       partition.layers.back() == 1 ? "allows" : "allow", length(limit), without);
  }
  // The layers shrink strictly up to F, so the largest finite delay is F - 1.
  const std::int64_t largest = partition.fixed_point_index - 1;
  const char* const are = largest == 1 ? "is" : "are";
  if (partition.fixed_point == 0) {
    if (largest == 0) return fmt::format("From no state is even one step {} safe.", without);
    return fmt::format("From the best state, {} {} {} safe.", length(largest), without, are);
  }
  if (!alone && partition.classes.size() == 1) {
    return "All agents coordinate within every step, so every delay is unbounded.";
  }
  if (largest < 0) return fmt::format("The {} never need to coordinate: every delay is unbounded.", who);
  return fmt::format("From {} the {} never need to coordinate; from the best of the others, {} {} {} safe.",
                     cells(partition.fixed_point), who, length(largest), without, are);
}

/// For how many cells D steps are more than they can bear.
std::string connection_text(const PartitionSummary& partition, const AnalysisSummary& summary) {
  const std::int64_t count = partition.never_without_connection;
  const bool unknown =
      partition.truncated && summary.connection_delay >= static_cast<std::int64_t>(partition.layers.size());
  return fmt::format("{}{} may never be without one, which takes {} to stand", unknown ? "at most " : "",
                     cells(count), duration(summary.connection_delay, summary.period, summary.period_unit));
}

std::string partition_text(const PartitionSummary& partition, const AnalysisSummary& summary) {
  Table table({Table::Align::left, Table::Align::left});
  table.add({"  layers", shortened(partition.layers)});
  table.add({"  fixed point",
             partition.truncated ? "not reached" : fmt::format("F = {}", partition.fixed_point_index)});
  table.add({"  unbounded", partition.truncated ? "unknown" : cells(partition.fixed_point)});
  if (summary.connection_delay > 0) table.add({"  connection", connection_text(partition, summary)});
  return fmt::format("\npartition {}\n{}  {}\n", partition.name, table.text(), meaning(partition, summary));
}

/// One line a partition.
std::string partitions_table(const AnalysisSummary& summary) {
  using Align = Table::Align;
  const bool has_delay = summary.connection_delay > 0;
  std::vector<Align> columns = {Align::left, Align::right, Align::right, Align::left};
  std::vector<std::string> heading = {"partition", "F", "unbounded", "longest finite delay"};
  if (has_delay) {
    columns.push_back(Align::right);
    heading.emplace_back("never without connection");
  }
  Table table(columns);
  table.add(heading);
  for (const PartitionSummary& partition : summary.partitions) {
    std::vector<std::string> row = {partition.name, fixed_point_text(partition),
                                    partition.truncated ? "unknown" : cells(partition.fixed_point),
                                    longest_delay_text(partition, summary)};
    if (has_delay) row.push_back(cells(partition.never_without_connection));
    table.add(std::move(row));
  }
  const std::string connection =
      has_delay ? fmt::format("A connection takes {} to stand.\n",
                              duration(summary.connection_delay, summary.period, summary.period_unit))
                : "";
  return "\n" + table.text() + connection;
}

std::string convention_text(const AnalysisSummary& summary) {
  using Align = Table::Align;
  Table table({Align::left, Align::right, Align::right, Align::right});
  table.add({"  agent", "keeps on average", "all in", "at most half in"});
  for (const ConventionSummary& own : summary.convention) {
    const std::int64_t half =
        std::accumulate(own.histogram.begin(), own.histogram.begin() + 5, std::int64_t{0});
    table.add({"  " + own.agent, fmt::format("{:.1f} %", 100 * own.mean), cells(own.full), cells(half)});
  }
  return fmt::format(
      "\nconvention\n{}  Agents that keep to it never need to coordinate inside the invariance set.\n",
      table.text());
}

std::string sets_text(const AnalysisSummary& summary) {
  Table table({Table::Align::left, Table::Align::left});
  if (const std::optional<ControllerSummary>& controller = summary.controller) {
    table.add(
        {"controller", fmt::format("{} of {} pairs, from {}", grouped(controller->pairs),
                                   grouped(summary.states * summary.inputs), printable(controller->file))});
  }
  table.add({"safe set", cells(summary.safe)});
  table.add({"invariance set", fmt::format("{} after {} sweep{}", cells(summary.invariant),
                                           grouped(summary.iterations), summary.iterations == 1 ? "" : "s")});
  table.add({"guarantee", guarantee_text(summary.guarantee)});
  return table.text();
}

std::string partitions_text(const AnalysisSummary& summary, const ProblemSpec& spec) {
  if (summary.safe == 0) return "\nThe safe set is empty: no cell satisfies \"safe\".\n";
  if (summary.invariant == 0 && spec.controller.synthesis == Synthesis::given) {
    return "\nThe invariance set is empty: there is no state from which every allowed action keeps the "
           "system "
           "safe.\n";
  }
  if (summary.invariant == 0) {
    return "\nThe invariance set is empty: no state can be kept safe, even if all agents always "
           "coordinate.\n";
  }
  if (summary.partitions.size() > kMostInFull) return partitions_table(summary);
  std::string text;
  for (const PartitionSummary& partition : summary.partitions) text += partition_text(partition, summary);
  if (summary.network) text += network_text(*summary.network, *spec.network, summary.invariant);
  if (!summary.convention.empty()) text += convention_text(summary);
  return text;
}

std::string closing_text(const AnalysisSummary& summary) {
  double seconds = 0;
  for (const auto& stage : summary.seconds) seconds += stage.second;
  return fmt::format("\nresults in {} ({:.2f} s on {} thread{}, {})\n", printable(summary.output), seconds,
                     summary.threads, summary.threads == 1 ? "" : "s", byte_size(summary.peak_memory_bytes));
}

Json partition_json(const PartitionSummary& partition) {
  Json json;
  json["name"] = partition.name;
  json["classes"] = partition.classes;
  json["F"] = partition.truncated ? Json() : Json(partition.fixed_point_index);
  json["fixed_point"] = partition.truncated ? Json() : Json(partition.fixed_point);
  json["layers"] = partition.layers;
  json["truncated"] = partition.truncated;
  json["never_without_connection"] = partition.never_without_connection;
  json["max_delay_time"] = partition.max_delay_time ? Json(*partition.max_delay_time) : Json();
  return json;
}

}  // namespace

std::string summary_text(const AnalysisSummary& summary, const ProblemSpec& spec) {
  return sizes(summary, spec) + sets_text(summary) + partitions_text(summary, spec) +
         coalition_text(summary) + requirements_text(summary, spec) + closing_text(summary);
}

std::string fixed_point_text(const PartitionSummary& partition) {
  return partition.truncated ? "not reached" : std::to_string(partition.fixed_point_index);
}

std::string unbounded_text(const PartitionSummary& partition) {
  return partition.truncated ? "unknown" : grouped(partition.fixed_point);
}

std::string longest_delay_text(const PartitionSummary& partition, const AnalysisSummary& summary) {
  const auto last = static_cast<std::int64_t>(partition.layers.size()) - 1;
  if (partition.truncated) return "at least " + duration(last, summary.period, summary.period_unit);
  return last == 0 ? "" : duration(last - 1, summary.period, summary.period_unit);
}

Json summary_json(const AnalysisSummary& summary, const ProblemSpec& spec) {
  Json json;
  json["name"] = summary.name;
  json["states"] = summary.states;
  json["inputs"] = summary.inputs;
  if (const std::optional<ControllerSummary>& controller = summary.controller) {
    json["controller"] = {
        {"file", controller->file}, {"sha256", controller->sha256}, {"pairs", controller->pairs}};
  }
  json["safe"] = summary.safe;
  json["invariant"] = summary.invariant;
  json["iterations"] = summary.iterations;
  json["guarantee"] = summary.guarantee;
  json["period"] = summary.period;
  json["period_unit"] = summary.period_unit;
  json["connection_delay"] = summary.connection_delay;
  json["partitions"] = Json::array();
  for (const PartitionSummary& partition : summary.partitions)
    json["partitions"].push_back(partition_json(partition));
  json["coalition"] = coalition_json(summary);
  if (summary.network) json["network"] = network_json(*summary.network);
  for (const ConventionSummary& own : summary.convention) {
    json["convention"].push_back(
        Json{{"agent", own.agent}, {"mean", own.mean}, {"full", own.full}, {"histogram", own.histogram}});
  }
  json["requirements"] = requirements_json(summary, spec);
  json["output"] = summary.output.empty() ? Json() : Json(summary.output);
  json["threads"] = summary.threads;
  json["seconds"] = Json::object();
  for (const auto& [stage, seconds] : summary.seconds) json["seconds"][stage] = seconds;
  json["work"] = Json::object();
  for (const AnalysisSummary::Work& work : summary.work) {
    json["work"][work.stage] = {
        {"sweeps", work.sweeps}, {"rows_visited", work.rows_visited}, {"rows_skipped", work.rows_skipped}};
  }
  json["peak_memory_bytes"] = summary.peak_memory_bytes;
  return json;
}

}  // namespace coordreq
