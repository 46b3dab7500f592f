#include "reach/switched_equation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/requires.hpp"
#include "expression/domains.hpp"
#include "expression/truth_of.hpp"

namespace coordreq {
namespace {

bool is_switch(Operator op) {
  return op == Operator::absolute || op == Operator::minimum || op == Operator::maximum ||
         (is_discontinuous(op) && op != Operator::if_else) || is_comparison(op);
}

constexpr double kUndefined = std::numeric_limits<double>::infinity();

double side_of(double x) {
  return std::isnan(x) ? kUndefined : x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0;
}

/// The side of the cut, if (x, y) is in that half of the plane.
double side_of_angle(double y, double x) {
  return std::isnan(y) || std::isnan(x) ? kUndefined : x >= 0.0 ? 0.0 : y >= 0.0 ? 1.0 : -1.0;
}

double side_of_floor(double x) {
  return std::isfinite(x) ? std::floor(x) : kUndefined;
}

/// The angle as if it went on across the cut.
double kept_angle(double y, double x, double side) {
  constexpr double kTurn = 6.283185307179586;
  const double angle = apply(Operator::angle, y, x);
  const bool crossed = side != 0.0 && side_of_angle(y, x) == -side;
  return crossed ? angle + side * kTurn : angle;
}

bool holds(Operator comparison, double side) {
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
  REQUIRES(!program.is_condition());
  for (const Rational& q : program.constants) constants_.push_back(nearest_double(q));
}

double SwitchedEquation::run(std::span<const double> slots, bool keep, bool move) {
  left_ = false;
  for (std::size_t i = 0; i < program_->nodes.size(); ++i) {
    const Program::Node& node = program_->nodes[i];
    double side = 0.0;
    if (is_switch(node.op)) {
      side = side_now(node);
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

double SwitchedEquation::side_now(const Program::Node& node) const {
  if (node.op == Operator::floor) return side_of_floor(numbers_[node.a]);
  if (node.op == Operator::angle) return side_of_angle(numbers_[node.a], numbers_[node.b]);
  return side_of(numbers_[node.a] - (is_unary_function(node.op) ? 0.0 : numbers_[node.b]));
}

double SwitchedEquation::number_of(const Program::Node& node, std::span<const double> slots,
                                   double side) const {
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
    case Operator::floor:
      return side;
    case Operator::angle:
      return kept_angle(numbers_[node.a], numbers_[node.b], side);
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
