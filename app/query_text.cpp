#include "app/query_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "answers/layers/trigger_table.hpp"
#include "app/network_report.hpp"
#include "app/query_values.hpp"
#include "app/text.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kMostTuples = 6;

/// A number at a length that can be read: exact if that is short, else rounded to six digits.
std::string shown(const Rational& value) {
  constexpr std::size_t kShort = 12;
  std::string text = to_text(value);
  return text.size() <= kShort ? text : fmt::format("{:.6g}", nearest_double(value));
}

std::string steps_text(std::int64_t steps, const ResultsReader& results) {
  const ProblemSpec& spec = results.spec();
  return duration(steps, nearest_double(spec.dynamics.period), spec.dynamics.unit);
}

/// "x1 in [0.095, 0.105)" for every state, "lane = 1" for a discrete one.
std::string box_text(const UniformGrid& grid, std::int64_t cell) {
  const CellBox box = box_of_cell(grid, cell);
  std::string text;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    text += text.empty() ? "" : ", ";
    text += grid[i].discrete
                ? fmt::format("{} = {}", grid[i].name, shown(box.centre[i]))
                : fmt::format("{} in [{}, {})", grid[i].name, shown(box.lower[i]), shown(box.upper[i]));
  }
  return text;
}

std::string state_text(const StateAnswer& answer, const UniformGrid& grid) {
  std::string text;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    text += fmt::format("{}{} = {}", i == 0 ? "" : ", ", grid[i].name, shown(answer.state[i]));
  }
  return text;
}

/// Why there is no cell.
std::string outside_text(const StateAnswer& answer, const UniformGrid& grid) {
  const Location& location = answer.location;
  const GridDimension& dimension = grid[location.dimension];
  const char* const side = location.above ? "above" : "below";
  const std::string value = fmt::format("{} = {}", dimension.name, shown(answer.state[location.dimension]));
  if (location.kind == Location::Kind::off_grid) {
    return fmt::format("no state of the system: {} is none of {} + k * {}", value, shown(dimension.first),
                       shown(dimension.step));
  }
  if (location.kind == Location::Kind::left_safely) {
    return fmt::format("outside: {} has left {} the domain, where the spec says that all is safe for ever",
                       value, side);
  }
  const Rational low = dimension.first - dimension.radius();
  const Rational high = dimension.point(dimension.count - 1) + dimension.radius();
  return fmt::format("outside: {} lies {} the domain, {} in [{}, {}{}; nothing is known there", value, side,
                     dimension.name, shown(low), shown(high), dimension.discrete ? "]" : ")");
}

std::string collision_text(const StateAnswer& answer, const ResultsReader& results) {
  if (answer.collision_time == ResultsReader::kNever) return "never, with coordination";
  if (answer.collision_time == 0) return "0 steps: not safe now";
  return "within " + steps_text(answer.collision_time, results) + ", whatever is coordinated";
}

std::string delay_text(std::int32_t delay, bool truncated, const ResultsReader& results) {
  if (delay == -2) return "none: the cell is not safe";
  if (delay == -1) return "none: no coordination keeps the system safe from here";
  if (delay == ResultsReader::kNever) return "unbounded: safe without coordination for ever";
  return (truncated ? "at least " : "") + steps_text(delay, results);
}

std::string trigger_text(std::int32_t trigger, const ResultsReader& results) {
  if (trigger == TriggerTable::kMustBeConnected) return "a connection must stand already";
  if (trigger < 0) return "none";
  if (trigger == ResultsReader::kNever) return "never need to connect";
  if (trigger == 0) {
    return results.spec().coordination.connection_delay > 0 ? "start to connect now" : "coordinate now";
  }
  return steps_text(trigger, results);
}

std::string tuple_text(const std::vector<Rational>& values) {
  std::string text;
  for (const Rational& value : values) text += (text.empty() ? "" : ", ") + shown(value);
  return values.size() == 1 ? text : "(" + text + ")";
}

/// Runs of actions that follow one another as "-0.8 ... 1"; of several inputs the first few tuples.
std::string actions_text(const ProblemSpec& spec, const std::vector<std::int32_t>& inputs,
                         const std::vector<bool>& actions) {
  std::string text;
  std::size_t shown = 0;
  for (std::size_t a = 0; a < actions.size(); ++a) {
    if (!actions[a]) continue;
    if (shown++ == kMostTuples) return text + " ...";
    text += (text.empty() ? "" : inputs.size() == 1 ? ", " : " ") + tuple_text(values_of(spec, inputs, a));
    std::size_t last = a;
    while (inputs.size() == 1 && last + 1 < actions.size() && actions[last + 1]) ++last;
    if (last > a) text += (last > a + 1 ? " ... " : ", ") + tuple_text(values_of(spec, inputs, last));
    a = last;
  }
  return text;
}

std::string class_text(const ProblemSpec& spec, const std::vector<std::int32_t>& inputs,
                       const std::vector<bool>& actions) {
  const auto count = std::count(actions.begin(), actions.end(), true);
  const auto total = static_cast<std::int64_t>(actions.size());
  if (count == 0) return "none";
  if (count == total) return fmt::format("all {}", grouped(total));
  std::vector<std::string> names;
  for (const std::int32_t i : inputs) names.push_back(spec.inputs[static_cast<std::size_t>(i)].name);
  const std::string name = names.size() == 1 ? names.front() : fmt::format("({})", fmt::join(names, ", "));
  return fmt::format("{} of {}: {} = {}", grouped(std::int64_t{count}), grouped(total), name,
                     actions_text(spec, inputs, actions));
}

std::string partition_text(const StateAnswer::Partition& answer, std::size_t p,
                           const ResultsReader& results) {
  const StoredPartition& stored = results.partitions()[p];
  Table table({Table::Align::left, Table::Align::left});
  table.add({"  delay", delay_text(answer.delay, is_lower_bound(answer.delay, stored), results)});
  table.add({"  countdown", trigger_text(answer.trigger, results)});
  for (std::size_t c = 0; c < answer.actions.size(); ++c) {
    const auto inputs = inputs_of_class(results.spec(), results.spec().coordination.partitions[p].classes[c]);
    table.add({"  actions of " + stored.classes[c], class_text(results.spec(), inputs, answer.actions[c])});
  }
  return fmt::format("\npartition {}\n{}", stored.name, table.text());
}

std::string coalition_text(const StateAnswer::Coalition& coalition, const ResultsReader& results) {
  Table table({Table::Align::left, Table::Align::left});
  const std::int32_t p = coalition.partition;
  table.add({"  cheapest partition", p >= 0    ? results.partitions()[static_cast<std::size_t>(p)].name
                                     : p == -3 ? "none: no partition of the file suffices"
                                               : "none"});
  std::vector<std::string> pairs;
  for (const std::size_t pair : coalition.critical_pairs) pairs.push_back(results.pairs()[pair]);
  if (p >= 0)
    table.add({"  critical pairs", pairs.empty() ? "none" : fmt::format("{}", fmt::join(pairs, ", "))});
  return fmt::format("\n{} without further contact\n{}",
                     steps_text(*results.spec().coordination.horizon, results), table.text());
}

std::string convention_text(const StateAnswer& answer, const ProblemSpec& spec) {
  Table table({Table::Align::left, Table::Align::left});
  for (std::size_t i = 0; i < answer.convention.size(); ++i) {
    const AgentSpec& agent = spec.agents[i];
    table.add({"  actions of " + agent.name, class_text(spec, agent.inputs, answer.convention[i])});
  }
  return "\nconvention\n" + table.text();
}

}  // namespace

std::string answer_text(const StateAnswer& answer, const ResultsReader& results) {
  const UniformGrid& grid = results.grid();
  Table table({Table::Align::left, Table::Align::left});
  table.add({"state", state_text(answer, grid)});
  if (answer.location.kind != Location::Kind::cell) {
    table.add({"cell", outside_text(answer, grid)});
    return table.text();
  }
  table.add(
      {"cell", fmt::format("number {}, index ({}): {}", grouped(answer.location.cell),
                           fmt::join(answer.location.index, ", "), box_text(grid, answer.location.cell))});
  table.add({"safe set", answer.safe ? "inside" : "outside"});
  table.add({"invariance set", answer.invariant ? "inside" : "outside"});
  table.add({"leaves the safe set", collision_text(answer, results)});
  table.add({"guarantee", guarantee_text(results.attributes().guarantee)});
  std::string text = table.text();
  for (std::size_t p = 0; p < answer.partitions.size(); ++p) {
    text += partition_text(answer.partitions[p], p, results);
  }
  if (answer.coalition) text += coalition_text(*answer.coalition, results);
  if (const auto& network = results.spec().network) text += safe_modes_text(*network, answer.safe_modes);
  if (!answer.convention.empty()) text += convention_text(answer, results.spec());
  return text;
}

}  // namespace coordreq
