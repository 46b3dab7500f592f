#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <type_traits>

#include "base/requires.hpp"

// Probabilities as levels: numbers that are not negative order as the unsigned integers that their bits are,
// so that the complement of the bits is a level: the greater the risk, the lower the level, and the minimum
// of levels over a box is the greatest risk in it. Level 0 (blocked) stands for certainty, kTop (safe for
// ever) for 0.
namespace coordreq {

/// float for levels of 32 bits, double for those of 64.
template <class Level>
using RiskNumber = std::conditional_t<sizeof(Level) == sizeof(float), float, double>;

/// @pre 0 <= risk <= 1, not -0
template <class Level>
[[nodiscard]] constexpr Level risk_level(RiskNumber<Level> risk) {
  REQUIRES(std::bit_cast<Level>(risk) <= std::bit_cast<Level>(RiskNumber<Level>{1}));
  return static_cast<Level>(~std::bit_cast<Level>(risk));
}
/// The level of a cell from which K has been left for certain.
template <class Level>
inline constexpr Level kCertain = risk_level<Level>(1);

template <class Level>
[[nodiscard]] constexpr RiskNumber<Level> risk_of(Level level) {
  return std::bit_cast<RiskNumber<Level>>(static_cast<Level>(~std::max(level, kCertain<Level>)));
}

/// The bits of a risk as a float, which are the integers of a field of risks; they have the same order.
[[nodiscard]] constexpr std::int32_t risk_bits(std::uint32_t level) {
  return std::bit_cast<std::int32_t>(risk_of(level));
}

}  // namespace coordreq
