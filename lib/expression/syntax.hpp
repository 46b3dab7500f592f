#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "expression/operators.hpp"
#include "expression/place.hpp"
#include "expression/table_function.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// An expression before names and types are resolved: a tree in postfix order, so that walking it needs a
/// stack of values and no recursion.
struct SyntaxTree {
  struct Node {
    Operator op = Operator::constant;
    std::uint32_t operands = 0;  ///< how many; a comparison with n of them is a chain, `add` with one is a
                                 ///< sign, `variable` with some is a call of a table
    std::uint32_t item = 0;      ///< `constant`: index into numbers; `variable`: into names; comparison: the
                                 ///< first of its `operands - 1` entries in comparisons
    std::size_t offset = 0;      ///< where it starts in the text
  };
  std::vector<Node> nodes;
  std::vector<Rational> numbers;
  std::vector<std::string_view> names;  ///< views into the text
  std::vector<Operator> comparisons;
};

/// @throws SpecError if the text is no expression of the grammar with these tables
[[nodiscard]] SyntaxTree parse(const SourceText& source, const TableLookup& tables);

}  // namespace coordreq
