#pragma once

#include <cstddef>
#include <vector>

#include "expression/program.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// A comparison of one state with a number.
struct StateBound {
  std::size_t state = 0;
  Rational value;
  bool is_upper = false;  ///< the state is at most that, else at least
};

/// The bounds that a condition demands: those joined by `and` at its top. Example: of "18 <= T and T <= 24
/// and (p > 1 or q > 1)" T from below at 18, from above at 24.
/// @param states their number; slots below it are theirs
[[nodiscard]] std::vector<StateBound> state_bounds(const Program& condition, std::size_t states);

}  // namespace coordreq
