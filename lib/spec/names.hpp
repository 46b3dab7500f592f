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
};

/// The datasets and groups that the results file has or will have at its top (contract, section 4).
[[nodiscard]] bool is_dataset_name(std::string_view name);

}  // namespace coordreq
