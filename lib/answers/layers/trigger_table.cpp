#include "answers/layers/trigger_table.hpp"

#include "base/requires.hpp"

namespace coordreq {

std::int32_t trigger_of(std::int32_t delay, std::int64_t connection_delay) {
  REQUIRES(connection_delay >= 0);
  if (delay < 0) return delay;
  if (delay == DelayLayers::kUnbounded) return TriggerTable::kNever;
  if (delay < connection_delay) return TriggerTable::kMustBeConnected;
  return static_cast<std::int32_t>(delay - connection_delay);
}

}  // namespace coordreq
