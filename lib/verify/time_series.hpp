#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "expression/domains.hpp"
#include "expression/evaluate.hpp"
#include "expression/program.hpp"

namespace coordreq {

/// Taylor coefficients in time of the solutions of x' = f(x), over boxes: x(t + h) = sum_k c_k h^k, where the
/// coefficients at a box of states enclose those of every solution in it (automatic differentiation by the
/// recurrences of Moore, "Interval Analysis", 1966, chapter 11). Scratch inside: one object a thread.
class TimeSeries {
 public:
  static constexpr std::size_t kOrder = 10;

  /// @param slots of the states, one an equation; all other variables are constants
  /// REQUIRES: the equations outlive this object.
  TimeSeries(std::vector<const Program*> equations, std::vector<std::uint32_t> slots);

  /// Coefficients 0, ..., kOrder of all states from `box`, by slot.
  /// @returns false if some function is not smooth or not defined over all of the box
  [[nodiscard]] bool expand(std::span<const Interval> box);
  /// Coefficient k of state i after expand().
  [[nodiscard]] const Interval& coefficient(std::size_t i, std::size_t k) const { return states_[i][k]; }
  /// f over the box, whether smooth or not. The result is not `total` where f is not defined.
  void derivative(std::span<const Interval> box, std::span<Interval> out);

 private:
  using Series = std::vector<Interval>;
  struct Node {
    Series value;
    Series second;  ///< of the companion that a recurrence needs, as cos for sin
    Series third;
    std::vector<Series> powers;
    Truth truth = Truth::undecided;
  };
  struct Equation {
    const Program* program;
    std::vector<Interval> constants;
    std::vector<Node> nodes;
  };

  bool extend(Equation& equation, std::span<const Interval> box, std::size_t k);
  bool extend_node(Equation& equation, std::size_t n, std::span<const Interval> box, std::size_t k);
  bool extend_condition(Equation& equation, std::size_t n, std::size_t k);
  bool extend_function(const Program::Node& node, Node& result, const Node& a, std::size_t k);
  bool extend_power(Node& result, const Node& a, const Node& b, std::size_t k);
  [[nodiscard]] bool extend_choice(const Program::Node& node, Equation& equation, Node& result,
                                   std::size_t k) const;

  std::vector<Equation> equations_;
  std::vector<Evaluator<Interval>> plain_;
  std::vector<std::uint32_t> slots_;
  std::vector<std::int32_t> state_of_slot_;  ///< -1: a constant
  std::vector<Series> states_;
};

}  // namespace coordreq
