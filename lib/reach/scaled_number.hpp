#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

// Numbers scaled to integers, as TransitionTable has them: units of 2^-32 of a grid step.
namespace coordreq {

inline constexpr std::int64_t kHalfStep = std::int64_t{1} << 31;
/// Largest magnitude, in steps, of one term of a sum.
inline constexpr double kLargestTerm = 0x1p26;

/// The greatest scaled number <= steps; nothing if it is too large or no number.
[[nodiscard]] inline std::optional<std::int64_t> scaled_below(double steps) {
  if (!(std::fabs(steps) <= kLargestTerm)) return std::nullopt;
  return static_cast<std::int64_t>(std::floor(steps * 0x1p32));  // scaling is exact
}

/// The least one >= steps.
[[nodiscard]] inline std::optional<std::int64_t> scaled_above(double steps) {
  if (!(std::fabs(steps) <= kLargestTerm)) return std::nullopt;
  return static_cast<std::int64_t>(std::ceil(steps * 0x1p32));
}

}  // namespace coordreq
