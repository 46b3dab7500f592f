#include "app/analysis_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "app/requirement_text.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

/// With more partitions than this each gets one line.
constexpr std::size_t kMostInFull = 3;

std::int64_t number(const Json& json) {
  return json.get<std::int64_t>();
}

std::string length(std::int64_t steps, const Json& summary) {
  return duration(steps, summary["period"].get<double>(), summary["period_unit"].get<std::string>());
}

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
  return fmt::format("{}: {} cells, {} joint inputs\n", summary["name"].get<std::string>(),
                     product(points, number(summary["states"])), product(values, number(summary["inputs"])));
}

bool is_joint(const Json& class_name) {
  return class_name.get<std::string>().find('+') != std::string::npos;
}

/// One sentence: for how long the classes can do without coordination, within which agents go on
/// coordinating.
std::string meaning(const Json& partition, const Json& summary) {
  const Json& classes = partition["classes"];
  const bool alone = std::none_of(classes.begin(), classes.end(), is_joint);
  const char* const who = alone ? "agents" : "classes";
  const char* const without = alone ? "without coordination" : "without coordination between classes";
  if (partition["truncated"]) {
    const auto limit = static_cast<std::int64_t>(partition["layers"].size()) - 1;
    const std::int64_t last = number(partition["layers"].back());
    return fmt::format("Stopped at max_delay: {} {} {} {}, perhaps more.", cells(last),
                       last == 1 ? "allows" : "allow", length(limit, summary), without);
  }
  // The layers shrink strictly up to F, so the largest finite delay is F - 1.
  const std::int64_t largest = number(partition["F"]) - 1;
  const std::int64_t unbounded = number(partition["fixed_point"]);
  const char* const are = largest == 1 ? "is" : "are";
  if (unbounded == 0) {
    if (largest == 0) return fmt::format("From no state is even one step {} safe.", without);
    return fmt::format("From the best state, {} {} {} safe.", length(largest, summary), without, are);
  }
  if (!alone && classes.size() == 1)
    return "All agents coordinate within every step, so every delay is unbounded.";
  if (largest < 0) return fmt::format("The {} never need to coordinate: every delay is unbounded.", who);
  return fmt::format("From {} the {} never need to coordinate; from the best of the others, {} {} {} safe.",
                     cells(unbounded), who, length(largest, summary), without, are);
}

/// For how many cells D steps are more than they can do without.
std::string connection_text(const Json& partition, const Json& summary) {
  const std::int64_t delay = number(summary["connection_delay"]);
  const bool unknown =
      partition["truncated"].get<bool>() && delay >= static_cast<std::int64_t>(partition["layers"].size());
  return fmt::format("{}{} may never be without one, which takes {} to stand", unknown ? "at most " : "",
                     cells(number(partition["never_without_connection"])), length(delay, summary));
}

std::string unbounded_cells(const Json& partition) {
  return partition["truncated"] ? "unknown" : cells(number(partition["fixed_point"]));
}

std::string partition_text(const Json& partition, const Json& summary) {
  Table table({Table::Align::left, Table::Align::left});
  table.add({"  layers", shortened(partition["layers"].get<std::vector<std::int64_t>>())});
  table.add({"  fixed point", (partition["truncated"] ? "" : "F = ") + fixed_point_text(partition)});
  table.add({"  unbounded", unbounded_cells(partition)});
  if (number(summary["connection_delay"]) > 0)
    table.add({"  connection", connection_text(partition, summary)});
  return fmt::format("\npartition {}\n{}  {}\n", partition["name"].get<std::string>(), table.text(),
                     meaning(partition, summary));
}

/// One line a partition.
std::string partitions_table(const Json& summary) {
  using Align = Table::Align;
  const std::int64_t delay = number(summary["connection_delay"]);
  std::vector<Align> columns = {Align::left, Align::right, Align::right, Align::left};
  std::vector<std::string> heading = {"partition", "F", "unbounded", "longest finite delay"};
  if (delay > 0) {
    columns.push_back(Align::right);
    heading.emplace_back("never without connection");
  }
  Table table(columns);
  table.add(heading);
  for (const Json& partition : summary["partitions"]) {
    std::vector<std::string> row = {partition["name"].get<std::string>(), fixed_point_text(partition),
                                    unbounded_cells(partition), longest_delay_text(partition, summary)};
    if (delay > 0) row.push_back(cells(number(partition["never_without_connection"])));
    table.add(std::move(row));
  }
  const std::string connection =
      delay > 0 ? fmt::format("A connection takes {} to stand.\n", length(delay, summary)) : "";
  return "\n" + table.text() + connection;
}

std::string convention_text(const Json& convention) {
  using Align = Table::Align;
  Table table({Align::left, Align::right, Align::right, Align::right});
  table.add({"  agent", "keeps on average", "all in", "at most half in"});
  for (const Json& own : convention) {
    const auto histogram = own["histogram"].get<std::vector<std::int64_t>>();
    const std::int64_t half = std::accumulate(histogram.begin(), histogram.begin() + 5, std::int64_t{0});
    table.add({"  " + own["agent"].get<std::string>(),
               fmt::format("{:.1f} %", 100 * own["mean"].get<double>()), cells(number(own["full"])),
               cells(half)});
  }
  return fmt::format(
      "\nconvention\n{}  Agents that keep to it never need to coordinate inside the invariance set.\n",
      table.text());
}

std::string sets_text(const Json& summary) {
  Table table({Table::Align::left, Table::Align::left});
  if (summary.contains("controller")) {
    const Json& controller = summary["controller"];
    table.add({"controller", fmt::format("{} of {} pairs, from {}", grouped(number(controller["pairs"])),
                                         grouped(number(summary["states"]) * number(summary["inputs"])),
                                         printable(controller["file"].get<std::string>()))});
  }
  const std::int64_t sweeps = number(summary["iterations"]);
  table.add({"safe set", cells(number(summary["safe"]))});
  table.add({"invariance set", fmt::format("{} after {} sweep{}", cells(number(summary["invariant"])),
                                           grouped(sweeps), sweeps == 1 ? "" : "s")});
  table.add({"guarantee", guarantee_text(summary["guarantee"].get<std::string>())});
  return table.text();
}

std::string partitions_text(const Json& summary, const ProblemSpec& spec) {
  if (summary["safe"] == 0) return "\nThe safe set is empty: no cell satisfies \"safe\".\n";
  if (summary["invariant"] == 0 && spec.controller.synthesis == Synthesis::given) {
    return "\nThe invariance set is empty: there is no state from which every allowed action keeps the "
           "system "
           "safe.\n";
  }
  if (summary["invariant"] == 0) {
    return "\nThe invariance set is empty: no state can be kept safe, even if all agents always "
           "coordinate.\n";
  }
  if (summary["partitions"].size() > kMostInFull) return partitions_table(summary);
  std::string text;
  for (const Json& partition : summary["partitions"]) text += partition_text(partition, summary);
  if (spec.network) text += network_text(summary, *spec.network);
  if (summary.contains("convention")) text += convention_text(summary["convention"]);
  return text;
}

std::string closing_text(const Json& summary) {
  const std::int64_t threads = number(summary["threads"]);
  const std::string output = summary["output"].is_null() ? "" : summary["output"].get<std::string>();
  return fmt::format("\nresults in {} ({:.2f} s on {} thread{}, {})\n", printable(output),
                     seconds_of(summary), threads, threads == 1 ? "" : "s",
                     byte_size(summary["peak_memory_bytes"].get<std::uint64_t>()));
}

}  // namespace

std::string summary_text(const Json& summary, const ProblemSpec& spec) {
  return sizes(summary, spec) + sets_text(summary) + partitions_text(summary, spec) +
         coalition_text(summary) + requirements_text(summary["requirements"], spec) + closing_text(summary);
}

std::string fixed_point_text(const Json& partition) {
  return partition["truncated"] ? "not reached" : std::to_string(number(partition["F"]));
}

std::string unbounded_text(const Json& partition) {
  return partition["truncated"] ? "unknown" : grouped(number(partition["fixed_point"]));
}

std::string longest_delay_text(const Json& partition, const Json& summary) {
  const auto last = static_cast<std::int64_t>(partition["layers"].size()) - 1;
  if (partition["truncated"]) return "at least " + length(last, summary);
  return last == 0 ? "" : length(last - 1, summary);
}

double seconds_of(const Json& summary) {
  double seconds = 0;
  for (const Json& stage : summary["seconds"]) seconds += stage.get<double>();
  return seconds;
}

}  // namespace coordreq
