#pragma once

#include <cstdint>
#include <string>

namespace coordreq {

/// 1234567 -> "1,234,567".
[[nodiscard]] inline std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, 1, ',');
  return text;
}
/// REQUIRES: number >= 0
[[nodiscard]] inline std::string grouped(std::int64_t number) {
  return grouped(static_cast<std::uint64_t>(number));
}

}  // namespace coordreq
