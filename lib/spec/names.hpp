#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "spec/json_document.hpp"

namespace coordreq {

/// The kind of a name in an expression.
enum class NameKind : std::uint8_t { state, input, disturbance, constant, definition, memory, table };

/// "state", "input", ...
[[nodiscard]] std::string_view kind_name(NameKind kind);

/// The datasets and groups that results of a spec have at their top, besides those of its states and inputs
/// (contract, sections 4 and 5). @pre unchecked: the document follows the schema.
[[nodiscard]] std::set<std::string, std::less<>> dataset_names(const JsonDocument::Node& root);

/// The names of a spec. Invariant: all different, none a function or a keyword, and no state or input, each
/// of which has a dataset of its own, called like another one.
class NameTable {
 public:
  NameTable() = default;
  explicit NameTable(std::set<std::string, std::less<>> datasets) : datasets_(std::move(datasets)) {}

  /// @throws SpecError if the name is taken or reserved; `pointer` says where it stands
  void add(const std::string& name, NameKind kind, const std::string& pointer);

  [[nodiscard]] std::optional<NameKind> find(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> all() const;

 private:
  struct Entry {
    NameKind kind;
    std::string pointer;
  };
  std::map<std::string, Entry> entries_;
  std::set<std::string, std::less<>> datasets_;
};

}  // namespace coordreq
