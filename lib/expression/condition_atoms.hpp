#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "expression/program.hpp"

namespace coordreq {

/// A condition as `and` and `or` of comparisons, each of which may depend on fewer variables than the whole:
/// `not` is moved into the comparisons, and max(a, b) >= c becomes a >= c or b >= c (and the like), where a
/// and b are defined everywhere. What the atoms prove by Kleene's logic is true of the condition.
struct ConditionAtoms {
  enum class Join : std::uint8_t { atom, both, either, always, never };
  struct Node {
    Join join;
    std::uint32_t a = 0;  ///< operands among `nodes`; of an atom its number
    std::uint32_t b = 0;
  };
  std::vector<Program> atoms;
  std::vector<Node> nodes;  ///< operands first, the result last
};

/// @param negated takes apart `not condition` instead
/// @returns nothing if the condition is a single atom, or needs more than a few dozen
[[nodiscard]] std::optional<ConditionAtoms> find_atoms(const Program& condition, bool negated);

}  // namespace coordreq
