#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "base/error.hpp"
#include "spec/partition_names.hpp"
#include "spec/problem_spec.hpp"
#include "spec/requirement_kind.hpp"
#include "spec/spec_errors.hpp"
#include "spec/spec_parts.hpp"
#include "spec/units.hpp"
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
    const bool is_match =
        partitions[i].name == node.text() || (named && partitions[i].canonical == named->canonical);
    if (is_match) return static_cast<std::int32_t>(i);
    names.push_back(partitions[i].name);
  }
  const std::string expected = coordination.all_partitions ? "the canonical name of a partition"
                                                           : "the partition " + quote_list(names, "or");
  throw SpecError(fmt::format("expected {}, found {}", expected, quote_text(node.text())), node.pointer());
}

/// Seconds of a unit of time, as udunits_spelling() has it.
std::optional<Rational> seconds_of(const std::string& unit) {
  static const std::map<std::string, Rational> kUnits = {{"ns", Rational(1, 1'000'000'000)},
                                                         {"us", Rational(1, 1'000'000)},
                                                         {"ms", Rational(1, 1000)},
                                                         {"s", 1},
                                                         {"min", 60},
                                                         {"h", 3600},
                                                         {"d", 86400}};
  const auto found = kUnits.find(unit);
  return found == kUnits.end() ? std::nullopt : std::optional(found->second);
}

/// Number of periods in a unit of time, rounded up.
std::int64_t periods_per(const Node& per, const std::string& unit, const Rational& period) {
  const std::optional<Rational> seconds = seconds_of(udunits_spelling(unit));
  if (!seconds) {
    throw SpecError(fmt::format("'per' needs a unit of time under 'dynamics', found {}",
                                unit.empty() ? "none" : quote_text(unit)),
                    per.pointer());
  }
  return ceil_to_int(*seconds_of(per.text()) / (period * *seconds));
}

/// The probability, and how often the rate is added to what it is compared with.
void read_risk_limit(const Scope& scope, const Node& root, const Node& object,
                     const std::optional<RiskSpec>& risk, const Rational& period,
                     RequirementSpec& requirement) {
  requirement.risk = scope.number(object["max_risk"]);
  if (requirement.risk < 0 || requirement.risk > 1) {
    throw SpecError("expected a probability from 0 to 1, found " + to_text(requirement.risk),
                    object["max_risk"].pointer());
  }
  requirement.per = object.text_or("per", "");
  // Agents without a clock are as safe as that says: see RiskSpec::is_safest.
  if (requirement.per.empty()) {
    requirement.steps = risk && risk->is_safest ? risk->horizon : 0;
  } else {
    requirement.steps = periods_per(object["per"], root["dynamics"].text_or("unit", ""), period);
  }
}

/// Sets kind and steps. @returns the key that says so
std::string read_kind(const Scope& scope, const Node& object, const Rational& period,
                      RequirementSpec& requirement) {
  std::string key;
  for (const RequirementTraits& kind : requirement_kinds()) {
    for (const std::string& name : {kind.key, kind.key + "_time"}) {
      if (!object.has(name)) continue;
      key = name;
      requirement.kind = kind.kind;
      if (kind.kind == RequirementKind::invariant || kind.is_probability) continue;
      const StepRounding rounding = kind.is_upper_limit ? StepRounding::down : StepRounding::up;
      requirement.steps = name == kind.key ? read_integer(object[name])
                                           : read_steps_of_time(scope, object[name], period, rounding);
    }
  }
  return key;
}

/// Only then is the delay another one.
void check_limited_sight(const Node& node, const std::string& key, std::size_t states,
                         const std::vector<AgentSpec>& agents) {
  const auto is_limited = [&](const AgentSpec& agent) { return agent.sees && agent.sees->size() < states; };
  if (std::any_of(agents.begin(), agents.end(), is_limited)) return;
  throw SpecError(
      fmt::format("'{}' is for a spec in which some agent does not see all states, by 'sees'", key),
      node.pointer());
}

/// An analysis that stops before the requested steps could not tell whether the requirement holds.
void check_decidable(const Node& node, const RequirementSpec& requirement,
                     const CoordinationSpec& coordination) {
  if (!requirement.is_of_partition() || !coordination.max_delay ||
      requirement.steps <= *coordination.max_delay) {
    return;
  }
  throw SpecError(
      fmt::format("expected at most 'max_delay', {} step{}, where the analysis stops, found {} steps",
                  *coordination.max_delay, *coordination.max_delay == 1 ? "" : "s", requirement.steps),
      node.pointer());
}

RequirementSpec read_requirement(const Scope& scope, const Node& root, const Node& object,
                                 const std::vector<AgentSpec>& agents, const CoordinationSpec& coordination,
                                 const std::optional<RiskSpec>& risk, const Rational& period) {
  RequirementSpec requirement;
  requirement.name = object["name"].text();
  requirement.where = scope.expression(object["where"], ExpectedType::condition, Dependence::states);
  const std::string key = read_kind(scope, object, period, requirement);
  const RequirementTraits& kind = traits(requirement.kind);
  if (kind.needs == "sees") {
    check_limited_sight(object[key], key, root.elements("states").size(), agents);
  } else if (!kind.needs.empty() && !root.has(kind.needs)) {
    throw SpecError(fmt::format("'{}' is for a spec with the key '{}'", key, kind.needs),
                    object[key].pointer());
  }
  if (kind.is_probability) read_risk_limit(scope, root, object, risk, period, requirement);
  if (!requirement.is_of_partition() && object.has("partition")) {
    throw SpecError(fmt::format("'{}' is about all partitions, found 'partition' too", key),
                    object["partition"].pointer());
  }
  if (requirement.is_of_partition()) requirement.partition = read_partition(object, agents, coordination);
  check_decidable(object[key], requirement, coordination);
  return requirement;
}

}  // namespace

std::vector<RequirementSpec> read_requirements(const Scope& scope, const Node& root,
                                               const std::vector<AgentSpec>& agents,
                                               const CoordinationSpec& coordination,
                                               const std::optional<RiskSpec>& risk, const Rational& period) {
  std::vector<RequirementSpec> requirements;
  std::vector<std::string> names;
  ErrorList errors;
  for (const Node& object : root.elements("requirements")) {
    errors.attempt([&] { check_new_name(object["name"], names, "requirement"); });
    names.push_back(object["name"].text());
    errors.attempt([&] {
      requirements.push_back(read_requirement(scope, root, object, agents, coordination, risk, period));
    });
  }
  errors.raise();
  return requirements;
}

}  // namespace coordreq
