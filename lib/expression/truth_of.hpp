#pragma once

#include <vector>

#include "expression/program.hpp"
#include "numeric/truth.hpp"

namespace coordreq {

/// The truth of a node that is a condition, given the truths of the nodes before it.
/// @param comparison finds the truth of a node that compares two numbers
template <class Comparison>
[[nodiscard]] Truth truth_of(const Program::Node& node, const std::vector<Truth>& truths,
                             const Comparison& comparison) {
  switch (node.op) {
    case Operator::logical_and:
      return truth_and(truths[node.a], truths[node.b]);
    case Operator::logical_or:
      return truth_or(truths[node.a], truths[node.b]);
    case Operator::logical_not:
      return !truths[node.a];
    case Operator::literal_true:
      return Truth::yes;
    case Operator::literal_false:
      return Truth::no;
    case Operator::literal_undecided:
      return Truth::undecided;
    default:
      return comparison();
  }
}

}  // namespace coordreq
