#pragma once

#include "abstraction/abstraction.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

/// With two threads.
[[nodiscard]] Abstraction build(const ProblemSpec& spec);

/// Points of random cells, on corners and inside, and random disturbance signals must land in the posts
/// (Abstraction::raw); a failure of GoogleTest tells where one does not. Solutions are followed in plain
/// doubles with steps far finer than the cells.
void attack(const ProblemSpec& spec, const Abstraction& abstraction, int cases);
inline void attack(const ProblemSpec& spec, int cases) {
  attack(spec, build(spec), cases);
}

}  // namespace coordreq
