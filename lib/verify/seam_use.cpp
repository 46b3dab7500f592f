#include "verify/piece_choices.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace coordreq {
namespace {

/// A node as a function of x, as far as known.
struct Node {
  std::optional<Rational> slope;  ///< it is slope * x + (what does not depend on x)
  std::optional<Rational> value;  ///< it is a constant
  bool jumps = false;             ///< it uses x as a number
};

Node constant(const Rational& value) {
  return {.slope = Rational(0), .value = value, .jumps = false};
}

Node sum(const Node& a, const Node& b, int sign) {
  Node result;
  if (a.value && b.value) result.value = *a.value + sign * *b.value;
  if (a.slope && b.slope) result.slope = *a.slope + sign * *b.slope;
  return result;
}

Node product(const Node& a, const Node& b) {
  Node result;
  if (a.value && b.value) result.value = *a.value * *b.value;
  if (a.slope && b.slope && *a.slope == 0 && *b.slope == 0) result.slope = 0;
  if (a.value && b.slope) result.slope = *a.value * *b.slope;
  if (b.value && a.slope) result.slope = *b.value * *a.slope;
  return result;
}

/// Half turns that make a period of a function; 0: it has none.
int half_turns(Operator op) {
  if (op == Operator::sine || op == Operator::cosine) return 2;
  return op == Operator::tangent ? 1 : 0;
}

/// Whether an angle is whole periods of the function. What doubles round is far below the mismatch.
bool is_whole(double angle, Operator op) {
  constexpr double kMismatch = 1e-9;
  constexpr double kMost = 1e6;
  const double period = half_turns(op) * std::numbers::pi;
  if (!(period > 0) || !(angle < kMost)) return false;
  const double turns = std::round(angle / period);
  return turns >= 1 && std::abs(angle - turns * period) <= kMismatch;
}

class UseFinder {
 public:
  UseFinder(const Program& equation, std::uint32_t slot, const Rational& period)
      : equation_(equation), slot_(slot), period_(period) {}

  [[nodiscard]] bool jumps() {
    for (const Program::Node& node : equation_.nodes) nodes_.push_back(node_of(node));
    return nodes_.back().jumps;
  }

 private:
  [[nodiscard]] Node node_of(const Program::Node& node) const {
    if (node.op == Operator::constant) return constant(equation_.constants[node.a]);
    if (node.op == Operator::variable) {
      const bool is_slot = node.a == slot_;
      return {.slope = Rational(is_slot ? 1 : 0), .value = std::nullopt, .jumps = is_slot};
    }
    Node result = combined(node);
    const std::uint32_t operands[] = {node.a, node.b, node.c};
    const std::uint32_t* const end = operands + operand_count(node.op);
    result.jumps = std::any_of(operands, end, [&](std::uint32_t i) { return nodes_[i].jumps; });
    if (result.jumps && half_turns(node.op) > 0 && nodes_[node.a].slope)
      result.jumps = !is_whole(std::abs(Rational(*nodes_[node.a].slope * period_).get_d()), node.op);
    return result;
  }

  [[nodiscard]] Node combined(const Program::Node& node) const {
    switch (node.op) {
      case Operator::negate:
        return sum(constant(0), nodes_[node.a], -1);
      case Operator::add:
        return sum(nodes_[node.a], nodes_[node.b], 1);
      case Operator::subtract:
        return sum(nodes_[node.a], nodes_[node.b], -1);
      case Operator::multiply:
        return product(nodes_[node.a], nodes_[node.b]);
      case Operator::divide: {
        const std::optional<Rational>& by = nodes_[node.b].value;
        return by && *by != 0 ? product(nodes_[node.a], constant(1 / *by)) : of_others(node);
      }
      default:
        return of_others(node);
    }
  }

  /// Any function of what does not depend on x does not either.
  [[nodiscard]] Node of_others(const Program::Node& node) const {
    const std::uint32_t operands[] = {node.a, node.b, node.c};
    Node result;
    const bool depends = std::any_of(operands, operands + operand_count(node.op), [&](std::uint32_t i) {
      return !nodes_[i].slope || *nodes_[i].slope != 0;
    });
    if (!depends) result.slope = 0;
    return result;
  }

  const Program& equation_;
  std::uint32_t slot_;
  const Rational& period_;
  std::vector<Node> nodes_;
};

}  // namespace

bool jumps_at_seam(const Program& equation, std::uint32_t slot, const Rational& period) {
  return UseFinder(equation, slot, period).jumps();
}

}  // namespace coordreq
