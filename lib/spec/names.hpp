#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace coordreq {

/// What a name in an expression stands for.
enum class NameKind : std::uint8_t { state, input, disturbance, constant, definition, memory };

/// "state", "input", ...
[[nodiscard]] std::string_view kind_in_words(NameKind kind);

/// The names of a spec. Invariant: all different, none a function, a keyword or a dataset of the results
/// file.
class NameTable {
 public:
  /// Reserves what only the results of a goal are called.
  void reserve_goal_names() { has_goal_ = true; }
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
  bool has_goal_ = false;
};

/// The datasets and groups that the results file has or will have at its top (contract, sections 4 and 5).
[[nodiscard]] bool is_dataset_name(std::string_view name, bool has_goal);

}  // namespace coordreq
