#pragma once

#include <cstdint>

#include "answers/layers/delay_layers.hpp"

namespace coordreq {

/// Contract, "Trigger table": trigger(x) = delay(x) - D, how many steps the agents may go on alone before
/// they must start to connect, if a connection takes D steps. delay(x) is the k with x in T(k) of the paper,
/// Eq. (11); with D = 0 the table is its countdown, Eq. (13).
struct TriggerTable {
  static constexpr std::int32_t kMustBeConnected = -3;  ///< delay(x) < D: a connection must stand already
  static constexpr std::int32_t kNever = DelayLayers::kUnbounded;  ///< unbounded cells never need to
};

/// The entry for a cell of delay `delay` (kOutsideSafe and kOutsideInvariant stay as they are).
/// @pre connection_delay >= 0
[[nodiscard]] std::int32_t trigger_of(std::int32_t delay, std::int64_t connection_delay);

}  // namespace coordreq
