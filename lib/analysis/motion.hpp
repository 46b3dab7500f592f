#pragma once

#include <cstdint>
#include <vector>

#include "base/json.hpp"
#include "spec/spec_types.hpp"

namespace coordreq {

/// How far one state moves in a period at most, as far as a sample shows.
struct StateMotion {
  double amount = 0;  ///< in the unit of the state
  double cells = 0;   ///< in steps of its grid
  double share = 0;   ///< of its domain; 1 is all of it
};

/// What a sample shows.
struct Motion {
  std::vector<StateMotion> states;  ///< of the spec
  std::int64_t solutions = 0;       ///< that were followed
  std::int64_t left_out = 0;        ///< that were not, since those before took very many sub-steps
};

/// max over x, u and w of |x_i(tau) - x_i(0)|, before the rules for leaving the domain, for each state of the
/// spec; of one with an update, how far it jumps; 0 for one that a memory keeps. Tried at corners of the
/// domain with the ends of all inputs and disturbances, all corners if they are few, and at points between: a
/// fixed number of solutions, followed without a guarantee, so the greatest may be larger. Where a solution
/// is undefined it is skipped.
[[nodiscard]] Motion sample_motion(const SystemSpec& spec);

/// A list of `state`, `amount`, `cells` and `share`, to six digits.
[[nodiscard]] Json motion_json(const SystemSpec& spec, const std::vector<StateMotion>& motion);

}  // namespace coordreq
