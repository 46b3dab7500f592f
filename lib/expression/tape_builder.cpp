#include "expression/tape_builder.hpp"

#include "expression/domains.hpp"
#include "expression/functions.hpp"
#include "numeric/rational_functions.hpp"

namespace coordreq {
namespace {

/// Longer constants are not worth folding: a long sum of them would cost its length times their size.
constexpr std::size_t kMostFoldedBits = 16'384;

std::size_t mix(std::size_t seed, std::size_t value) {
  return (seed ^ (value + (seed >> 32U))) * 0x9E3779B97F4A7C15ULL;
}

}  // namespace

std::size_t TapeBuilder::RationalHash::operator()(const Rational& q) const {
  const std::size_t negative = sgn(q) < 0 ? 1 : 0;
  return mix(mix(negative, mpz_get_ui(q.get_num_mpz_t())), mpz_get_ui(q.get_den_mpz_t()));
}

TapeBuilder::Index TapeBuilder::constant(const Rational& value) {
  const auto [entry, is_new] = index_of_constant_.try_emplace(value, static_cast<Index>(constants_.size()));
  if (is_new) constants_.push_back(value);
  return insert({Operator::constant, entry->second, 0, 0});
}

TapeBuilder::Index TapeBuilder::variable(std::uint32_t slot) {
  return insert({Operator::variable, slot, 0, 0});
}

/// a - b floor(a / b). It lies between 0 and b, which intervals would not see.
TapeBuilder::Index TapeBuilder::modulo(Index a, Index b) {
  const Index zero = constant(0);
  const Index turns = apply(Operator::floor, apply(Operator::divide, a, b));
  const Index rest = apply(Operator::subtract, a, apply(Operator::multiply, b, turns));
  const Index most = apply(Operator::minimum, apply(Operator::maximum, zero, b), rest);
  return apply(Operator::maximum, apply(Operator::minimum, zero, b), most);
}

TapeBuilder::Index TapeBuilder::apply(Operator op, Index a, Index b, Index c) {
  if (op == Operator::modulo) return modulo(a, b);
  const Program::Node node{op, a, b, c};
  if (const std::optional<Index> folded = fold(node)) return *folded;
  // An interval does not know that both factors are the same; its square does.
  if (op == Operator::multiply && a == b) return insert({Operator::power, a, constant(2), 0});
  return insert(node);
}

TapeBuilder::Index TapeBuilder::copy(const Program& program, const Program::Node& node,
                                     const std::vector<Index>& here) {
  if (node.op == Operator::constant) return constant(program.constants[node.a]);
  if (node.op == Operator::variable) return variable(node.a);
  const std::size_t operands = operand_count(node.op);
  return apply(node.op, operands > 0 ? here[node.a] : 0, operands > 1 ? here[node.b] : 0,
               operands > 2 ? here[node.c] : 0);
}

TapeBuilder::Index TapeBuilder::merge(const Program& program) {
  std::vector<Index> here;
  here.reserve(program.nodes.size());
  index_of_node_.reserve(nodes_.size() + program.nodes.size(), nodes_);
  for (const Program::Node& node : program.nodes) here.push_back(copy(program, node, here));
  return here.back();
}

Program TapeBuilder::extract(Index result) const {
  std::vector<bool> needed(result + std::size_t{1}, false);
  needed[result] = true;
  for (std::size_t i = result + std::size_t{1}; i-- > 0;) {
    if (!needed[i]) continue;
    const Program::Node& node = nodes_[i];
    const std::size_t operands = operand_count(node.op);
    if (operands > 0) needed[node.a] = true;
    if (operands > 1) needed[node.b] = true;
    if (operands > 2) needed[node.c] = true;
  }
  Program program;
  std::vector<Index> new_index(needed.size(), 0);
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (!needed[i]) continue;
    Program::Node node = nodes_[i];
    const std::size_t operands = operand_count(node.op);
    if (operands > 0) node.a = new_index[node.a];
    if (operands > 1) node.b = new_index[node.b];
    if (operands > 2) node.c = new_index[node.c];
    if (node.op == Operator::constant) {
      program.constants.push_back(constants_[node.a]);
      node.a = static_cast<Index>(program.constants.size() - 1);
    }
    new_index[i] = static_cast<Index>(program.nodes.size());
    program.nodes.push_back(node);
  }
  return program;
}

TapeBuilder::Index TapeBuilder::insert(const Program::Node& node) {
  const Index index = index_of_node_.find_or_append(node, nodes_);
  if (index == total_.size()) total_.push_back(is_total(node));
  return index;
}

/// Whether a node is defined everywhere, whatever the values of operands that are no constants.
bool TapeBuilder::is_total(const Program::Node& node) const {
  const std::size_t operands = operand_count(node.op);
  if ((operands > 0 && !total_[node.a]) || (operands > 1 && !total_[node.b]) ||
      (operands > 2 && !total_[node.c]))
    return false;
  const Rational* const b = operands == 2 ? constant_at(node.b) : nullptr;
  if (node.op == Operator::divide) return b != nullptr && *b != 0;
  if (node.op == Operator::power) return b != nullptr && is_integer(*b) && *b >= 0;
  return !is_number_function(node.op) || number_function(node.op).is_defined_everywhere();
}

TapeBuilder::Index TapeBuilder::insert_truth(bool value) {
  return insert({value ? Operator::literal_true : Operator::literal_false, 0, 0, 0});
}

const Rational* TapeBuilder::constant_at(Index index) const {
  const Program::Node& node = nodes_[index];
  return node.op == Operator::constant ? &constants_[node.a] : nullptr;
}

std::optional<bool> TapeBuilder::truth_at(Index index) const {
  if (nodes_[index].op == Operator::literal_true) return true;
  if (nodes_[index].op == Operator::literal_false) return false;
  return std::nullopt;
}

std::optional<TapeBuilder::Index> TapeBuilder::fold(const Program::Node& node) {
  return is_condition(node.op) ? fold_condition(node) : fold_number(node);
}

std::optional<TapeBuilder::Index> TapeBuilder::fold_number(const Program::Node& node) {
  if (node.op == Operator::if_else) {
    if (node.b == node.c && total_[node.a]) return node.b;
    const std::optional<bool> choice = truth_at(node.a);
    return choice ? std::optional<Index>(*choice ? node.b : node.c) : std::nullopt;
  }
  const bool is_unary = is_unary_function(node.op);
  const Rational* const a = constant_at(node.a);
  const Rational* const b = is_unary ? a : constant_at(node.b);
  if (a == nullptr || b == nullptr || bit_size(*a) + bit_size(*b) > kMostFoldedBits) return std::nullopt;
  const std::optional<Rational> value = number_function(node.op).exactly(*a, *b);
  if (!value || bit_size(*value) > kMostFoldedBits) return std::nullopt;
  return constant(*value);
}

std::optional<TapeBuilder::Index> TapeBuilder::fold_condition(const Program::Node& node) {
  if (operand_count(node.op) == 0) return std::nullopt;
  if (is_comparison(node.op)) {
    const Rational* const a = constant_at(node.a);
    const Rational* const b = constant_at(node.b);
    if (a == nullptr || b == nullptr) return std::nullopt;
    return insert_truth(compare(node.op, *a, *b) == Truth::yes);
  }
  const std::optional<bool> a = truth_at(node.a);
  if (node.op == Operator::logical_not) return a ? std::optional<Index>(insert_truth(!*a)) : std::nullopt;
  const std::optional<bool> b = truth_at(node.b);
  // `or` with true is true and with false is the other operand; `and` the other way round.
  const bool decisive = node.op == Operator::logical_or;
  if (a) return *a == decisive ? node.a : node.b;
  if (b) return *b == decisive ? node.b : node.a;
  return std::nullopt;
}

}  // namespace coordreq
