#include "spec/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "expression/program.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

/// A dataset, and the key of the spec that asks for it; none: it is always there.
struct Dataset {
  std::string_view name;
  std::string_view object = {};
  std::string_view key = {};
};

constexpr Dataset kDatasets[] = {{"collision_time"},
                                 {"delay"},
                                 {"fixed_point_index"},
                                 {"invariant"},
                                 {"layer"},
                                 {"layer_size"},
                                 {"partition"},
                                 {"safe"},
                                 {"spec"},
                                 {"spec_json"},
                                 {"trigger"},
                                 {"approach_delay", "goal"},
                                 {"approach_fixed_point_index", "goal"},
                                 {"approach_layer", "goal"},
                                 {"approach_layer_size", "goal"},
                                 {"approach_trigger", "goal"},
                                 {"arrival", "goal"},
                                 {"mode", "network"},
                                 {"network_safe", "network"},
                                 {"risk", "risk"},
                                 {"risk_drawn", "risk", "start"},
                                 {"risk_start", "risk", "start"},
                                 {"coalition", "coordination", "horizon"},
                                 {"critical_pair", "coordination", "horizon"},
                                 {"pair", "coordination", "horizon"},
                                 {"coalition", "coordination", "horizon_time"},
                                 {"critical_pair", "coordination", "horizon_time"},
                                 {"pair", "coordination", "horizon_time"},
                                 {"agent", "coordination", "convention"},
                                 {"convention_freedom", "coordination", "convention"},
                                 {"blind_countdown", "agents", "sees"},
                                 {"blind_delay", "agents", "sees"},
                                 {"blind_fixed_point_index", "agents", "sees"},
                                 {"blind_layer", "agents", "sees"},
                                 {"blind_layer_size", "agents", "sees"},
                                 {"silent", "agents", "sees"},
                                 {"silent_layer", "agents", "sees"},
                                 {"silence", "silence"},
                                 {"silence_fixed_point_index", "silence"},
                                 {"silence_layer", "silence"},
                                 {"silence_layer_size", "silence"},
                                 {"silence_set", "silence", "then"},
                                 {"counterexample", "requirements"},
                                 {"controller", "output", "controller"},
                                 {"actions", "output", "actions"},
                                 {"layers", "output", "layers"},
                                 {"abstraction", "output", "abstraction"}};

/// The key is there, and is not `false`.
bool asks_for(const Node& root, const Dataset& dataset) {
  const std::string object(dataset.object), key(dataset.key);
  if (object.empty()) return true;
  if (!root.has(object)) return false;
  if (key.empty()) return true;
  if (object == "agents") {
    const std::vector<Node> agents = root.elements(object);
    return std::any_of(agents.begin(), agents.end(), [&](const Node& agent) { return agent.has(key); });
  }
  if (!root[object].has(key)) return false;
  const Node value = root[object][key];
  return value.is_number() || value.is_text() || value.is_object() ||
         (!value.is_null() && root[object].flag(key));
}

}  // namespace

std::string_view kind_name(NameKind kind) {
  constexpr std::array<std::string_view, 7> kNames{"state",      "input",  "disturbance", "constant",
                                                   "definition", "memory", "table"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::set<std::string, std::less<>> dataset_names(const Node& root) {
  std::set<std::string, std::less<>> names;
  for (const Dataset& dataset : kDatasets) {
    if (asks_for(root, dataset)) names.emplace(dataset.name);
  }
  return names;
}

void NameTable::add(const std::string& name, NameKind kind, const std::string& pointer) {
  if (is_reserved_name(name)) {
    throw SpecError(quote_text(name) + " is a function or keyword, expected another name", pointer);
  }
  const bool is_axis = kind == NameKind::state || kind == NameKind::input;
  if (is_axis && datasets_.contains(name)) {
    throw SpecError(quote_text(name) + " is a dataset of the results file, expected another name", pointer);
  }
  const auto [entry, is_new] = entries_.try_emplace(name, Entry{kind, pointer});
  if (!is_new) {
    throw SpecError(
        fmt::format("the name {} is taken, it stands at {} too", quote_text(name), entry->second.pointer),
        pointer);
  }
}

std::optional<NameKind> NameTable::find(const std::string& name) const {
  const auto entry = entries_.find(name);
  return entry == entries_.end() ? std::nullopt : std::optional(entry->second.kind);
}

std::vector<std::string> NameTable::all() const {
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries_) names.push_back(name);
  return names;
}

}  // namespace coordreq
