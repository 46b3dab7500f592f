#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "spec/check_limits.hpp"
#include "spec/coordination_spec.hpp"
#include "spec/partition_names.hpp"
#include "spec/spec_parts.hpp"
#include "spec/system_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

std::vector<std::string> names_of(const std::vector<AgentSpec>& agents) {
  std::vector<std::string> names;
  names.reserve(agents.size());
  for (const AgentSpec& agent : agents) names.push_back(agent.name);
  return names;
}

AgentClasses read_classes(const Node& list, const std::vector<AgentSpec>& agents) {
  const std::vector<std::string> names = names_of(agents);
  std::vector<bool> is_listed(agents.size(), false);
  AgentClasses classes;
  for (const Node& members : list.elements()) {
    classes.emplace_back();
    for (const Node& name : members.elements()) {
      const std::int32_t agent = index_of_name(name, names, "an agent");
      if (is_listed[static_cast<std::size_t>(agent)]) {
        throw SpecError(fmt::format("the agent {} is listed twice", quote_text(name.text())), name.pointer());
      }
      is_listed[static_cast<std::size_t>(agent)] = true;
      classes.back().push_back(agent);
    }
  }
  return classes;
}

/// Names and canonical names are ways to call a partition, in the spec and in paths of the results file.
void check_new_partition(const PartitionSpec& partition, const std::vector<PartitionSpec>& known,
                         const std::string& pointer) {
  for (std::size_t i = 0; i < known.size(); ++i) {
    const std::string other = fmt::format("/coordination/partitions/{}", i);
    if (known[i].canonical == partition.canonical) {
      throw SpecError(fmt::format("the partition {} is listed twice, it stands at {} too",
                                  quote_text(partition.canonical), other),
                      pointer);
    }
    if (known[i].name == partition.name || known[i].canonical == partition.name ||
        known[i].name == partition.canonical) {
      throw SpecError(fmt::format("the partition name {} is taken by {}", quote_text(partition.name), other),
                      pointer);
    }
  }
}

std::vector<PartitionSpec> read_partitions(const Node& list, const std::vector<AgentSpec>& agents) {
  std::vector<PartitionSpec> partitions;
  for (const Node& object : list.elements()) {
    PartitionSpec partition =
        make_partition(agents, read_classes(object["classes"], agents), object.text_or("name", ""));
    check_new_partition(partition, partitions, object.pointer());
    partitions.push_back(std::move(partition));
  }
  return partitions;
}

std::vector<LinkCostSpec> read_link_costs(const Scope& scope, const Node& object,
                                          const std::vector<AgentSpec>& agents) {
  const std::vector<std::string> names = names_of(agents);
  std::vector<LinkCostSpec> costs;
  for (const Node& link : object.elements("link_cost")) {
    const Node pair = link["agents"];
    const auto [first, second] =
        std::minmax({index_of_name(pair[0], names, "an agent"), index_of_name(pair[1], names, "an agent")});
    LinkCostSpec cost{first, second, scope.number(link["cost"])};
    if (first == second) throw SpecError("expected two agents, found one twice", pair.pointer());
    if (cost.cost < 0)
      throw SpecError("expected a cost >= 0, found " + to_text(cost.cost), link["cost"].pointer());
    for (const LinkCostSpec& other : costs) {
      if (other.first != cost.first || other.second != cost.second) continue;
      throw SpecError(fmt::format("the link of {} and {} is listed twice", quote_text(pair[0].text()),
                                  quote_text(pair[1].text())),
                      link.pointer());
    }
    costs.push_back(std::move(cost));
  }
  return costs;
}

/// Layers that stop before the horizon cannot say who is safe until then.
void check_horizon(const CoordinationSpec& coordination, const std::string& pointer) {
  if (!coordination.max_delay || *coordination.horizon <= *coordination.max_delay) return;
  throw SpecError(fmt::format("expected a horizon of at most max_delay = {} steps, found {} steps",
                              *coordination.max_delay, *coordination.horizon),
                  pointer);
}

/// @pre unchecked: `max_delay` has been read.
void read_horizon(const Scope& scope, const Node& object, const Rational& period,
                  CoordinationSpec& coordination) {
  if (object.has("horizon")) {
    coordination.horizon = read_integer(object["horizon"]);
    check_horizon(coordination, object["horizon"].pointer());
  } else if (object.has("horizon_time")) {
    const Node time = object["horizon_time"];
    coordination.horizon_time = scope.time(time);
    coordination.horizon = read_steps_of_time(scope, time, period);
    check_horizon(coordination, time.pointer());
  }
  if (!coordination.horizon && !object.elements("link_cost").empty()) {
    throw SpecError("'link_cost' is for the coalition map, expected 'horizon' or 'horizon_time' beside it",
                    object["link_cost"].pointer());
  }
}

std::vector<PartitionSpec> all_partitions(const Node& keyword, const std::vector<AgentSpec>& agents) {
  check_all_partitions(agents.size(), keyword.pointer());
  return make_all_partitions(agents);
}

}  // namespace

CoordinationSpec read_coordination(const Scope& scope, const Node& root, const std::vector<AgentSpec>& agents,
                                   const Rational& period) {
  CoordinationSpec coordination;
  const bool is_given = root.has("coordination");
  if (!is_given || !root["coordination"].has("partitions")) {
    coordination.partitions.push_back(make_partition(agents, {}, ""));
  }
  if (!is_given) return coordination;
  const Node object = root["coordination"];
  if (object.has("partitions")) {
    const Node partitions = object["partitions"];
    coordination.all_partitions = partitions.is_text();
    coordination.partitions = coordination.all_partitions ? all_partitions(partitions, agents)
                                                          : read_partitions(partitions, agents);
  }
  if (object.has("max_delay") && !object["max_delay"].is_null()) {
    coordination.max_delay = read_integer(object["max_delay"]);
  }
  if (object.has("connection_delay"))
    coordination.connection_delay = read_integer(object["connection_delay"]);
  coordination.link_cost = read_link_costs(scope, object, agents);
  read_horizon(scope, object, period, coordination);
  coordination.convention = object.flag("convention");
  return coordination;
}

}  // namespace coordreq
