#pragma once

#include <cstdint>
#include <string>

#include "spec/spec_types.hpp"

namespace coordreq {

/// Bounds of a number of steps, and how a time becomes steps.
struct StepBounds {
  std::int64_t least = 1;
  bool is_upper_limit = false;  ///< then a time is rounded down to periods, else up
};

/// "4" steps, or "2 s", "500ms", "1h": a time, in periods of the spec; "2.5 round" in a unit of the spec that
/// is no unit of time.
/// @throws UsageError naming the option
[[nodiscard]] std::int64_t steps_or_time(const std::string& text, const DynamicsSpec& dynamics,
                                         const std::string& option, const StepBounds& bounds = {});

}  // namespace coordreq
