#include <fmt/format.h>

#include "base/error.hpp"
#include "spec/partition_names.hpp"
#include "spec/spec_errors.hpp"
#include "spec/spec_parts.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

/// Index of the partition that a requirement is about.
std::optional<std::int32_t> read_partition(const Node& object, const std::vector<AgentSpec>& agents,
                                           const CoordinationSpec& coordination) {
  const std::vector<PartitionSpec>& partitions = coordination.partitions;
  if (!object.has("partition")) {
    if (partitions.size() == 1) return 0;
    throw SpecError("missing key 'partition', there is more than one", object.pointer());
  }
  const Node node = object["partition"];
  const std::optional<PartitionSpec> named = parse_partition_name(agents, node.text());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < partitions.size(); ++i) {
    const bool is_meant =
        partitions[i].name == node.text() || (named && partitions[i].canonical == named->canonical);
    if (is_meant) return static_cast<std::int32_t>(i);
    names.push_back(partitions[i].name);
  }
  const std::string expected = coordination.all_partitions ? "the canonical name of a partition"
                                                           : "the partition " + quote_list(names, "or");
  throw SpecError(fmt::format("expected {}, found {}", expected, quote_text(node.text())), node.pointer());
}

/// An analysis that stops before `min_delay` could not tell whether the requirement holds.
void check_decidable(const Node& object, const RequirementSpec& requirement,
                     const CoordinationSpec& coordination) {
  if (!requirement.min_delay || !coordination.max_delay ||
      *requirement.min_delay <= *coordination.max_delay) {
    return;
  }
  throw SpecError(
      fmt::format("expected at most 'max_delay', {} steps, where the analysis stops, found {} steps",
                  *coordination.max_delay, *requirement.min_delay),
      object[object.has("min_delay") ? "min_delay" : "min_delay_time"].pointer());
}

RequirementSpec read_requirement(const Scope& scope, const Node& object, const std::vector<AgentSpec>& agents,
                                 const CoordinationSpec& coordination, const Rational& period) {
  RequirementSpec requirement;
  requirement.name = object["name"].text();
  requirement.where = scope.expression(object["where"], ExpectedType::condition, Over::states);
  requirement.invariant = object.has("invariant");
  if (requirement.invariant && object.has("partition")) {
    throw SpecError("'invariant' is about all partitions, found 'partition' too",
                    object["partition"].pointer());
  }
  if (!requirement.invariant) requirement.partition = read_partition(object, agents, coordination);
  if (object.has("min_delay")) requirement.min_delay = read_integer(object["min_delay"]);
  if (object.has("min_delay_time")) {
    requirement.min_delay = read_steps_of_time(scope, object["min_delay_time"], period);
  }
  check_decidable(object, requirement, coordination);
  return requirement;
}

}  // namespace

std::vector<RequirementSpec> read_requirements(const Scope& scope, const Node& root,
                                               const std::vector<AgentSpec>& agents,
                                               const CoordinationSpec& coordination, const Rational& period) {
  std::vector<RequirementSpec> requirements;
  std::vector<std::string> names;
  ErrorList errors;
  for (const Node& object : root.elements("requirements")) {
    errors.attempt([&] { check_new_name(object["name"], names, "requirement"); });
    names.push_back(object["name"].text());
    errors.attempt(
        [&] { requirements.push_back(read_requirement(scope, object, agents, coordination, period)); });
  }
  errors.raise();
  return requirements;
}

}  // namespace coordreq
