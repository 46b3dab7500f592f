#include "spec/partition_names.hpp"

#include <algorithm>
#include <utility>

namespace coordreq {
namespace {

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0;;) {
    const std::size_t end = text.find(separator, start);
    parts.push_back(text.substr(start, end - start));
    if (end == std::string_view::npos) return parts;
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

std::optional<PartitionSpec> parse_partition_name(const std::vector<AgentSpec>& agents,
                                                  std::string_view text) {
  AgentClasses classes;
  std::vector<bool> is_named(agents.size(), false);
  std::size_t named = 0;
  for (const std::string_view part : split(text, '|')) {
    classes.emplace_back();
    for (const std::string_view name : split(part, '+')) {
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
