#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace coordreq {

/// A set of pairs (cell, joint input) as results files hold them: bytes [cells, ceil(m / 8)], cells row-major
/// in the order of the spec, joint input u at bit u % 8 of byte u / 8.
struct PackedPairs {
  std::int64_t inputs = 0;  ///< m
  std::vector<std::uint8_t> bytes;

  [[nodiscard]] static std::int64_t bytes_for(std::int64_t inputs) { return (inputs + 7) / 8; }
  [[nodiscard]] std::int64_t bytes_per_cell() const { return bytes_for(inputs); }
  [[nodiscard]] bool test(std::int64_t cell, std::int64_t u) const {
    return (std::uint32_t{bytes[static_cast<std::size_t>(cell * bytes_per_cell() + u / 8)]} >> (u % 8) &
            1U) != 0;
  }
  [[nodiscard]] std::int64_t count() const {
    std::int64_t total = 0;
    for (const std::uint8_t byte : bytes) total += std::popcount(byte);
    return total;
  }
  void set(std::int64_t cell, std::int64_t u) {
    std::uint8_t& byte = bytes[static_cast<std::size_t>(cell * bytes_per_cell() + u / 8)];
    byte = static_cast<std::uint8_t>(byte | 1U << (u % 8));
  }
};

}  // namespace coordreq
