#include "reach/tape_values.hpp"

namespace coordreq {
namespace {

using Kind = Choice::Kind;

Choice pin_to_middle(const Interval& range) {
  const double middle = midpoint(range);
  return {Kind::pinned, {middle, middle}};
}

Choice decide_discontinuity(const FlowTape::Node& node, const TapeValues<Interval>& values,
                            const Interval& range) {
  if (node.op == Operator::sign || node.op == Operator::floor) return pin_to_middle(range);
  if (node.op == Operator::angle)
    return meets_cut_of_angles(values[node.a], values[node.b]) ? pin_to_middle(range)
                                                               : Choice{Kind::first, {}};
  const Truth condition = values.truth(node.a);
  if (condition == Truth::undecided) return pin_to_middle(range);
  return {condition == Truth::yes ? Kind::first : Kind::second, {}};
}

Kind decide_kink(const FlowTape::Node& node, const TapeValues<Interval>& values) {
  const Interval& a = values[node.a];
  if (node.op == Operator::absolute) {
    return a.lower >= 0.0 ? Kind::first : a.upper <= 0.0 ? Kind::first_negated : Kind::undecided;
  }
  const Interval& b = values[node.b];
  const Interval& low = node.op == Operator::minimum ? a : b;
  const Interval& high = node.op == Operator::minimum ? b : a;
  if (low.upper <= high.lower) return Kind::first;
  return high.upper <= low.lower ? Kind::second : Kind::undecided;
}

bool decide_all(const FlowTape& tape, const TapeValues<Interval>& values, bool with_discontinuities,
                Choices& choices) {
  bool smooth = true;
  for (const std::uint32_t i : tape.values) {
    const FlowTape::Node& node = tape.nodes[i];
    if (!node.is_choice()) continue;
    if (!is_discontinuous(node.op)) {
      choices[i].kind = decide_kink(node, values);
      smooth = smooth && choices[i].kind != Kind::undecided;
    } else if (with_discontinuities) {
      choices[i] = decide_discontinuity(node, values, values[i]);
    }
  }
  return smooth;
}

}  // namespace

bool decide(const FlowTape& tape, const TapeValues<Interval>& values, Choices& choices) {
  return decide_all(tape, values, true, choices);
}

bool decide_kinks(const FlowTape& tape, const TapeValues<Interval>& values, Choices& choices) {
  return decide_all(tape, values, false, choices);
}

}  // namespace coordreq
