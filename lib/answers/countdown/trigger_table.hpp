#pragma once

#include <cstdint>

#include "answers/step_codes.hpp"

namespace coordreq {

/// The entry of the trigger table (contract) for a cell of delay `delay`: delay - D, how many steps the
/// agents may go on alone before they must start to connect, if a connection takes D steps; kMustBeConnected
/// if they have none. delay(x) is the k with x in T(k) of the paper, Eq. (11); with D = 0 the table is its
/// countdown, Eq. (13). kOutsideSafe, kOutsideInvariant and kUnbounded stay as they are.
/// @pre connection_delay >= 0
[[nodiscard]] std::int32_t trigger_of(std::int32_t delay, std::int64_t connection_delay);

}  // namespace coordreq
