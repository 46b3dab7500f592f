#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace coordreq {

/// Counts and indices of the problem are signed, those of the standard containers are not: the latter. Takes
/// i >= 0.
[[nodiscard]] constexpr std::size_t at(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// Whether a list of indices has this one.
template <class Index, class Number>
[[nodiscard]] bool contains(const std::vector<Index>& list, Number index) {
  return std::find(list.begin(), list.end(), static_cast<Index>(index)) != list.end();
}

}  // namespace coordreq
