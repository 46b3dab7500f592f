#include "reach/flow_tape.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace coordreq {
namespace {

using Index = std::uint32_t;
using Node = FlowTape::Node;
using Rule = FlowTape::Rule;

/// Powers above this are taken by the general rule, which needs a base without 0.
constexpr int kLargestProduct = 64;

/// Puts nodes on a tape, equal ones once.
class TapeWriter final : private NodeWriter {
 public:
  TapeWriter(FlowTape& tape, std::span<const Index> states, std::span<const Index> disturbances)
      : tape_(tape) {
    for (Index i = 0; i < states.size(); ++i) moving_[states[i]] = i;
    for (const Index slot : disturbances) moving_[slot] = FlowTape::kNone;
  }

  Index write(const Program& program) {
    std::vector<Index> indices(program.nodes.size());
    for (std::size_t i = 0; i < program.nodes.size(); ++i) {
      const Program::Node& node = program.nodes[i];
      if (node.op == Operator::constant) {
        indices[i] = constant(program.constants[node.a]);
      } else if (node.op == Operator::variable) {
        indices[i] = put(node.op, node.a);
      } else {
        indices[i] = put(node.op, indices[node.a], indices[node.b], indices[node.c]);
      }
    }
    return indices.back();
  }

  /// Writes the derivatives of the equations along a tangent of the states.
  /// @returns whether they have one, as they have wherever they are defined unless there is a kink or a jump
  bool write_tangents(std::span<const Index> equations, std::vector<Index> tangents) {
    tangents_ = std::move(tangents);
    for (const Index i : equations) {
      const std::optional<Index> along = tangent(i);
      tape_.outputs.push_back(along ? *along : put_number(0));
    }
    return is_smooth_;
  }

  [[nodiscard]] bool is_fixed(Index i) const { return degree_[i] == 0; }
  [[nodiscard]] bool is_affine(Index i) const { return degree_[i] <= 1; }

 private:
  Index constant(const Rational& value) {
    const auto [known, is_new] = constants_.emplace(value, static_cast<Index>(tape_.constants.size()));
    if (is_new) tape_.constants.push_back(value);
    return put(Operator::constant, known->second);
  }

  Index put_operation(Operator op, Index a, Index b) override { return put(op, a, b); }
  Index put_number(int value) override { return constant(Rational(value)); }

  Index put(Operator op, Index a = 0, Index b = 0, Index c = 0) {
    if (operand_count(op) < 2) b = 0;
    if (operand_count(op) < 3) c = 0;
    const auto key = std::make_tuple(op, a, b, c);
    if (const auto known = index_of_.find(key); known != index_of_.end()) return known->second;
    const bool moving_power = op == Operator::power && !(is_fixed(a) && is_fixed(b));
    return moving_power ? power(key) : add({op, a, b, c}, key);
  }

  using Key = std::tuple<Operator, Index, Index, Index>;

  /// The derivative of a node; nothing if that is 0.
  std::optional<Index> tangent(Index i) {
    if (const auto known = tangent_of_.find(i); known != tangent_of_.end()) return known->second;
    return tangent_of_[i] = new_tangent(i);
  }

  std::optional<Index> new_tangent(Index i) {
    const Node node = tape_.nodes[i];
    const auto of_p = [&] { return tangent(node.p); };
    switch (node.rule) {
      case Rule::fixed:
        return std::nullopt;
      case Rule::variable:
        return put(Operator::variable, tangents_[node.p]);
      case Rule::sum:
        return combined(Operator::add, of_p(), tangent(node.q));
      case Rule::difference:
        return combined(Operator::subtract, of_p(), tangent(node.q));
      case Rule::negation:
        return combined(Operator::subtract, std::nullopt, of_p());
      case Rule::product:
        return combined(Operator::add, scaled(of_p(), Operator::multiply, node.q),
                        scaled(tangent(node.q), Operator::multiply, node.p));
      case Rule::quotient:
        return scaled(combined(Operator::subtract, of_p(), scaled(tangent(node.q), Operator::multiply, i)),
                      Operator::divide, node.q);
      case Rule::chain:
        return scaled(of_p(), Operator::multiply, node.q);
      case Rule::inverse_chain:
        return scaled(of_p(), Operator::divide, node.q);
      case Rule::root:
        return scaled(of_p(), Operator::divide, put(Operator::multiply, put_number(2), i));
      case Rule::power:
        return scaled(scaled(of_p(), Operator::multiply, put(Operator::multiply, node.q, i)),
                      Operator::divide, node.p);
      case Rule::angle:
      case Rule::pick:
        break;
    }
    is_smooth_ = false;
    return std::nullopt;
  }

  std::optional<Index> combined(Operator op, std::optional<Index> a, std::optional<Index> b) {
    if (a && b) return put(op, *a, *b);
    if (b && op == Operator::subtract) return put(Operator::negate, *b);
    return a ? a : b;
  }
  std::optional<Index> scaled(std::optional<Index> a, Operator op, Index by) {
    return a ? std::optional(put(op, *a, by)) : a;
  }

  Index add(Node node, const Key& key) {
    const auto index = static_cast<Index>(tape_.nodes.size());
    index_of_[key] = index;
    degree_.push_back(degree_of(node));
    tape_.nodes.push_back(node);
    if (degree_.back() == 0 || is_condition(node.op)) return index;
    if (node.rule == Rule::fixed) set_rule(index);
    return index;
  }

  /// 0: fixed, 1: at most linear, 2: anything.
  [[nodiscard]] int degree_of(const Node& node) const {
    if (node.op == Operator::constant || node.op == Operator::literal_true ||
        node.op == Operator::literal_false) {
      return 0;
    }
    if (node.op == Operator::variable) return moving_.contains(node.a) ? 1 : 0;
    const int a = degree_[node.a];
    if (node.op == Operator::negate) return a;
    if (is_unary_function(node.op) || node.op == Operator::logical_not) return a == 0 ? 0 : 2;
    const int b = degree_[node.b];
    if (node.op == Operator::add || node.op == Operator::subtract) return std::max(a, b);
    if (node.op == Operator::multiply) return std::min(a + b, 2);
    if (node.op == Operator::divide) return b == 0 ? a : 2;
    if (node.op == Operator::if_else) return a == 0 ? std::max(b, degree_[node.c]) : 2;
    return a == 0 && b == 0 ? 0 : 2;
  }

  void set_rule(Index i) {
    const Node node = tape_.nodes[i];
    if (node.op == Operator::variable) return rule(i, Rule::variable, moving_.at(node.a), 0);
    if (node.op == Operator::if_else) return rule(i, Rule::pick, node.b, node.c);
    const FunctionSeries& series = number_function(node.op).series;
    const Index second = is_unary_function(node.op) ? 0 : node.b;
    rule(i, series.rule, node.a, series.factor == nullptr ? second : series.factor(*this, node.a, i));
    if (series.rule != Rule::angle) return;
    const Index two = constant(Rational(2));
    const Index y_square = put(Operator::power, node.a, two);
    const Index x_square = put(Operator::power, node.b, two);
    const Index square = put(Operator::add, y_square, x_square);
    tape_.nodes[i].square = square;
  }

  /// Integer powers as products, so that a base that contains 0 does no harm; moving exponents by exp, log.
  Index power(const Key& key) {
    const Index base = std::get<1>(key);
    const Index exponent = std::get<2>(key);
    const Node node{Operator::power, base, exponent, 0};
    const Node by = tape_.nodes[exponent];
    if (!is_fixed(exponent)) {
      const Index logarithm = put(Operator::logarithm, base);
      const Index argument = put(Operator::multiply, exponent, logarithm);
      const Index index = add(node, key);
      rule(index, Rule::chain, argument, index);
      return index;
    }
    if (by.op == Operator::constant && is_integer(tape_.constants[by.a]) &&
        abs(tape_.constants[by.a]) <= kLargestProduct) {
      return integer_power(node, key, static_cast<int>(tape_.constants[by.a].get_d()));
    }
    return add(node, key);
  }

  Index integer_power(Node node, const Key& key, int n) {
    const auto to = [&](int m) {
      return m == 1 ? node.a : put(Operator::power, node.a, constant(Rational(m)));
    };
    if (n == 0) {
      node.rule = Rule::product;  // 1 * 1, although 0 ^ 0 has moving parts
      node.p = node.q = constant(Rational(1));
    } else if (n < 0) {
      node.rule = Rule::quotient;
      node.p = constant(Rational(1));
      node.q = to(-n);
    } else if (n == 1) {
      node.rule = Rule::product;
      node.p = constant(Rational(1));
      node.q = node.a;
    } else {
      node.rule = Rule::product;
      node.p = to(n / 2);
      node.q = to(n - n / 2);
    }
    return add(node, key);
  }

  void rule(Index i, Rule rule, Index p, Index q) {
    tape_.nodes[i].rule = rule;
    tape_.nodes[i].p = p;
    tape_.nodes[i].q = q;
  }

  FlowTape& tape_;
  std::map<Index, Index> moving_;  ///< slot -> state, or kNone for a disturbance
  std::map<Rational, Index> constants_;
  std::map<Key, Index> index_of_;
  std::vector<int> degree_;
  std::vector<Index> tangents_;  ///< slots, one a state
  std::map<Index, std::optional<Index>> tangent_of_;
  bool is_smooth_ = true;
};

std::vector<Index> value_operands(const Node& node) {
  switch (operand_count(node.op)) {
    case 0:
      return {};
    case 1:
      return {node.a};
    case 2:
      return {node.a, node.b};
    default:
      return {node.a, node.b, node.c};
  }
}

std::vector<Index> series_operands(const Node& node) {
  switch (node.rule) {
    case Rule::fixed:
    case Rule::variable:
      return {};
    case Rule::negation:
    case Rule::root:
      return {node.p};
    case Rule::pick:
      return is_unary_function(node.op) ? std::vector<Index>{node.p} : std::vector<Index>{node.p, node.q};
    case Rule::angle:
      return {node.p, node.q, node.square};
    default:
      return {node.p, node.q};
  }
}

/// Which nodes are reached from those in `open`.
template <class Operands>
std::vector<bool> reached(const FlowTape& tape, std::vector<Index> open, Operands operands) {
  std::vector<bool> seen(tape.nodes.size());
  while (!open.empty()) {
    const Index i = open.back();
    open.pop_back();
    if (seen[i]) continue;
    seen[i] = true;
    for (const Index next : operands(tape.nodes[i])) open.push_back(next);
  }
  return seen;
}

}  // namespace

FlowTape::FlowTape(std::span<const Program* const> equations, std::span<const std::uint32_t> states,
                   std::span<const std::uint32_t> disturbances)
    : state_slots(states.begin(), states.end()) {
  TapeWriter writer(*this, states, disturbances);
  for (const Program* equation : equations) outputs.push_back(writer.write(*equation));
  list_nodes(writer);
}

template <class Writer>
void FlowTape::list_nodes(const Writer& writer) {
  for (const Index i : outputs) affine = affine && writer.is_affine(i);
  const std::vector<bool> for_value = reached(*this, outputs, value_operands);
  const std::vector<bool> for_series = reached(*this, outputs, series_operands);
  for (Index i = 0; i < nodes.size(); ++i) {
    if (writer.is_fixed(i)) {
      fixed_values.push_back(i);
      continue;
    }
    if (for_value[i]) values.push_back(i);
    if (for_series[i]) series.push_back(i);
  }
  for (const Index output : outputs) {
    const std::vector<bool> needed = reached(*this, {output}, value_operands);
    std::vector<Index>& list = values_of.emplace_back();
    std::copy_if(values.begin(), values.end(), std::back_inserter(list), [&](Index i) { return needed[i]; });
  }
}

std::optional<FlowTape> FlowTape::with_tangents(std::span<const Program* const> equations,
                                                std::span<const std::uint32_t> states,
                                                std::span<const std::uint32_t> tangents) {
  FlowTape tape;
  tape.state_slots.assign(states.begin(), states.end());
  tape.state_slots.insert(tape.state_slots.end(), tangents.begin(), tangents.end());
  TapeWriter writer(tape, tape.state_slots, {});
  for (const Program* equation : equations) tape.outputs.push_back(writer.write(*equation));
  if (!writer.write_tangents(std::vector<Index>(tape.outputs), {tangents.begin(), tangents.end()}))
    return std::nullopt;
  tape.list_nodes(writer);
  return tape;
}

}  // namespace coordreq
