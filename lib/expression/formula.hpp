#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "expression/program.hpp"
#include "numeric/truth.hpp"

namespace coordreq {

/// A condition taken apart: comparisons of numbers, and how `and`, `or` and `not` join them.
struct Formula {
  /// `difference` op 0.
  struct Comparison {
    Operator op;
    Program difference;
  };
  struct Node {
    Operator op;          ///< logical or literal; `less` stands for any comparison
    std::uint32_t a = 0;  ///< operands among `nodes`; of a comparison its number among `comparisons`
    std::uint32_t b = 0;
  };
  std::vector<Comparison> comparisons;
  std::vector<Node> nodes;  ///< operands first, the result last

  /// By Kleene's logic from the truth of each comparison.
  [[nodiscard]] Truth value(std::span<const Truth> truths) const;
};

/// @pre `condition` is a condition
[[nodiscard]] Formula take_apart(const Program& condition);

}  // namespace coordreq
