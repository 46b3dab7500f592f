#include "export/base64.hpp"

#include <cstdint>

namespace coordreq {

std::string base64(std::span<const std::byte> bytes) {
  constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = i; j < i + 3; ++j)
      group = group << 8U | (j < bytes.size() ? std::to_integer<std::uint32_t>(bytes[j]) : 0U);
    for (std::size_t letter = 0; letter < 4; ++letter) {
      const bool padding = i + letter > bytes.size();
      text += padding ? '=' : kLetters[group >> (18 - 6 * letter) & 63U];
    }
  }
  return text;
}

}  // namespace coordreq
