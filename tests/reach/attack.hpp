#pragma once

#include "reach/abstraction.hpp"
#include "reach/simulated_flow.hpp"
#include "spec/spec_types.hpp"

namespace coordreq::test {

/// Points of random cells, on corners and inside, and random disturbance signals must land in the posts
/// (Abstraction::raw); a failure of GoogleTest tells where one does not.
void attack(const SystemSpec& spec, const Abstraction& abstraction, int cases);
inline void attack(const SystemSpec& spec, int cases) {
  attack(spec, build(spec), cases);
}

}  // namespace coordreq::test
