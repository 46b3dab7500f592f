#include "spec/partition_names.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "base/requires.hpp"
#include "spec/coordination_spec.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> segments;
  for (std::size_t start = 0;;) {
    const std::size_t end = text.find(separator, start);
    segments.push_back(text.substr(start, end - start));
    if (end == std::string_view::npos) return segments;
    start = end + 1;
  }
}

std::string canonical_name(const std::vector<AgentSpec>& agents, const AgentClasses& classes) {
  std::string name;
  for (const std::vector<std::int32_t>& members : classes) {
    if (!name.empty()) name += '|';
    name += class_name(agents, members);
  }
  return name;
}

/// No agent is there twice, and no class empty.
[[maybe_unused]] bool are_disjoint(const AgentClasses& classes) {
  std::set<std::int32_t> agents;
  return std::ranges::all_of(classes, [&agents](const auto& members) {
    return !members.empty() && std::ranges::all_of(members, [&agents](std::int32_t agent) {
      return agents.insert(agent).second;
    });
  });
}

/// All ways to put the agents from `labels.size()` on into the classes used so far or into one more
/// (restricted growth strings), in lexicographic order.
void add_labellings(std::size_t agents, std::vector<std::size_t>& labels, std::size_t classes,
                    std::vector<std::vector<std::size_t>>& all) {
  if (labels.size() == agents) {
    all.push_back(labels);
    return;
  }
  for (std::size_t label = 0; label <= classes; ++label) {
    labels.push_back(label);
    add_labellings(agents, labels, std::max(classes, label + 1), all);
    labels.pop_back();
  }
}

AgentClasses classes_of(const std::vector<std::size_t>& labels) {
  AgentClasses classes(1 + *std::max_element(labels.begin(), labels.end()));
  for (std::size_t agent = 0; agent < labels.size(); ++agent)
    classes[labels[agent]].push_back(static_cast<std::int32_t>(agent));
  return classes;
}

}  // namespace

std::string class_name(const std::vector<AgentSpec>& agents, const std::vector<std::int32_t>& members) {
  std::string name;
  for (const std::int32_t agent : members) {
    if (!name.empty()) name += '+';
    name += agents[static_cast<std::size_t>(agent)].name;
  }
  return name;
}

PartitionSpec make_partition(const std::vector<AgentSpec>& agents, AgentClasses classes, std::string name) {
  REQUIRES(are_disjoint(classes));
  std::vector<bool> is_listed(agents.size(), false);
  for (std::vector<std::int32_t>& members : classes) {
    std::sort(members.begin(), members.end());
    for (const std::int32_t agent : members) is_listed[static_cast<std::size_t>(agent)] = true;
  }
  for (std::size_t i = 0; i < agents.size(); ++i) {
    if (!is_listed[i]) classes.push_back({static_cast<std::int32_t>(i)});
  }
  // Classes are disjoint, so this orders them by their first agents.
  std::sort(classes.begin(), classes.end());
  PartitionSpec partition;
  partition.canonical = canonical_name(agents, classes);
  partition.name = name.empty() ? partition.canonical : std::move(name);
  partition.classes = std::move(classes);
  return partition;
}

std::vector<PartitionSpec> make_all_partitions(const std::vector<AgentSpec>& agents) {
  std::vector<std::vector<std::size_t>> labellings;
  std::vector<std::size_t> labels;
  add_labellings(agents.size(), labels, 0, labellings);
  std::vector<PartitionSpec> partitions;
  for (const std::vector<std::size_t>& one : labellings)
    partitions.push_back(make_partition(agents, classes_of(one), ""));
  std::stable_sort(partitions.begin(), partitions.end(), [](const PartitionSpec& a, const PartitionSpec& b) {
    return a.classes.size() < b.classes.size();
  });
  return partitions;
}

std::optional<PartitionSpec> parse_partition_name(const std::vector<AgentSpec>& agents,
                                                  std::string_view text) {
  AgentClasses classes;
  std::vector<bool> is_named(agents.size(), false);
  std::size_t named = 0;
  for (const std::string_view segment : split(text, '|')) {
    classes.emplace_back();
    for (const std::string_view name : split(segment, '+')) {
      const auto agent =
          std::find_if(agents.begin(), agents.end(), [&](const AgentSpec& one) { return one.name == name; });
      if (agent == agents.end()) return std::nullopt;
      const auto index = static_cast<std::size_t>(agent - agents.begin());
      if (is_named[index]) return std::nullopt;
      is_named[index] = true;
      ++named;
      classes.back().push_back(static_cast<std::int32_t>(index));
    }
  }
  if (named != agents.size()) return std::nullopt;
  return make_partition(agents, std::move(classes), "");
}

}  // namespace coordreq
