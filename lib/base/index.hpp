#pragma once

#include <cstddef>
#include <cstdint>

namespace coordreq {

/// Counts and indices of the problem are signed, those of the standard containers are not: the latter. Takes
/// i >= 0.
[[nodiscard]] constexpr std::size_t at(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

}  // namespace coordreq
