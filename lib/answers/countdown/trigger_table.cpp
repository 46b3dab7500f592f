#include "answers/countdown/trigger_table.hpp"

#include "answers/step_codes.hpp"
#include "base/requires.hpp"

namespace coordreq {

std::int32_t trigger_of(std::int32_t delay, std::int64_t connection_delay) {
  REQUIRES(connection_delay >= 0);
  if (delay < 0) return delay;
  if (delay == kUnbounded) return kUnbounded;
  if (delay < connection_delay) return kMustBeConnected;
  return static_cast<std::int32_t>(delay - connection_delay);
}

}  // namespace coordreq
