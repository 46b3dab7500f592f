#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/requires.hpp"

namespace coordreq {

/// 1234567 -> "1,234,567".
[[nodiscard]] inline std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, 1, ',');
  return text;
}
/// @pre number >= 0
[[nodiscard]] inline std::string grouped(std::int64_t number) {
  REQUIRES(number >= 0);
  return grouped(static_cast<std::uint64_t>(number));
}

/// "a, b and c".
[[nodiscard]] inline std::string list_text(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i)
    text += (i == 0 ? "" : i + 1 == items.size() ? " and " : ", ") + items[i];
  return text;
}

/// "1,234 steps", "1 step". @pre count >= 0
[[nodiscard]] inline std::string count_of(std::int64_t count, const std::string& noun) {
  REQUIRES(count >= 0);
  return grouped(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace coordreq
