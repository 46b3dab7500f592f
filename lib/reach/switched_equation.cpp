#include "reach/switched_equation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "expression/domains.hpp"
#include "expression/truth_of.hpp"

namespace coordreq {
namespace {

bool is_switch(Operator op) {
  return op == Operator::absolute || op == Operator::sign || op == Operator::minimum ||
         op == Operator::maximum || is_comparison(op);
}

constexpr int kUndefined = 2;

int side_of(double x) {
  return std::isnan(x) ? kUndefined : x > 0.0 ? 1 : x < 0.0 ? -1 : 0;
}

bool holds(Operator comparison, int side) {
  switch (comparison) {
    case Operator::less:
      return side < 0;
    case Operator::less_equal:
      return side <= 0;
    case Operator::greater:
      return side > 0;
    case Operator::greater_equal:
      return side >= 0;
    case Operator::equal:
      return side == 0;
    default:
      return side != 0;
  }
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace

SwitchedEquation::SwitchedEquation(const Program& program)
    : program_(&program),
      has_switches_(std::any_of(program.nodes.begin(), program.nodes.end(),
                                [](const Program::Node& node) { return is_switch(node.op); })),
      numbers_(program.nodes.size()),
      truths_(program.nodes.size()),
      sides_(program.nodes.size()) {
  for (const Rational& q : program.constants) constants_.push_back(nearest_double(q));
}

double SwitchedEquation::run(std::span<const double> slots, bool keep, bool move) {
  left_ = false;
  for (std::size_t i = 0; i < program_->nodes.size(); ++i) {
    const Program::Node& node = program_->nodes[i];
    int side = 0;
    if (is_switch(node.op)) {
      side = side_of(numbers_[node.a] - (is_unary_function(node.op) ? 0.0 : numbers_[node.b]));
      left_ = left_ || side != sides_[i];
      if (move) sides_[i] = side;
      if (keep && side != kUndefined) side = sides_[i];
    }
    if (is_condition(node.op)) {
      truths_[i] = truth_of(node, truths_, [&] {
        return side == kUndefined ? Truth::undecided : to_truth(holds(node.op, side));
      });
    } else {
      numbers_[i] = number_of(node, slots, side);
    }
  }
  return numbers_.back();
}

double SwitchedEquation::number_of(const Program::Node& node, std::span<const double> slots, int side) const {
  if (side == kUndefined) return kNaN;
  switch (node.op) {
    case Operator::constant:
      return constants_[node.a];
    case Operator::variable:
      return slots[node.a];
    case Operator::if_else:
      return select(truths_[node.a], numbers_[node.b], numbers_[node.c]);
    case Operator::absolute:
      return side < 0 ? -numbers_[node.a] : numbers_[node.a];
    case Operator::sign:
      return side;
    case Operator::minimum:
      return side < 0 ? numbers_[node.a] : numbers_[node.b];
    case Operator::maximum:
      return side > 0 ? numbers_[node.a] : numbers_[node.b];
    default:
      break;
  }
  if (is_unary_function(node.op)) return apply(node.op, numbers_[node.a]);
  return apply(node.op, numbers_[node.a], numbers_[node.b]);
}

}  // namespace coordreq
