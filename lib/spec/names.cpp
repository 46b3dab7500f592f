#include "spec/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "expression/program.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

constexpr std::array<std::string_view, 25> kDatasetNames{"abstraction",
                                                         "action",
                                                         "actions",
                                                         "agent",
                                                         "coalition",
                                                         "collision_time",
                                                         "controller",
                                                         "convention_freedom",
                                                         "counterexample",
                                                         "critical_pair",
                                                         "delay",
                                                         "first",
                                                         "fixed_point_index",
                                                         "invariant",
                                                         "last",
                                                         "layer",
                                                         "layer_size",
                                                         "layers",
                                                         "mode",
                                                         "network_safe",
                                                         "pair",
                                                         "partition",
                                                         "safe",
                                                         "spec",
                                                         "trigger"};

}  // namespace

std::string_view kind_in_words(NameKind kind) {
  constexpr std::array<std::string_view, 6> kWords{"state",    "input",      "disturbance",
                                                   "constant", "definition", "memory"};
  return kWords[static_cast<std::size_t>(kind)];
}

bool is_dataset_name(std::string_view name) {
  return std::binary_search(kDatasetNames.begin(), kDatasetNames.end(), name);
}

void NameTable::add(const std::string& name, NameKind kind, const std::string& pointer) {
  if (is_reserved_name(name)) {
    throw SpecError(quote_text(name) + " is a function or keyword, expected another name", pointer);
  }
  if (is_dataset_name(name)) {
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
