#include "expression/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <unordered_set>

#include "expression/other_names.hpp"
#include "expression/place.hpp"
#include "expression/syntax.hpp"
#include "expression/table_function.hpp"
#include "expression/tape_builder.hpp"
#include "expression/token.hpp"

namespace coordreq {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr std::array<std::string_view, 6> kKeywords{"pi", "and", "or", "not", "true", "false"};

const TableFunction* no_table(std::string_view /*name*/) {
  return nullptr;
}

/// Gives names and types to a syntax tree: walks its postfix order with a stack of operands.
class Linker {
 public:
  Linker(const SourceText& source, const Lookup& lookup, const TableLookup& tables)
      : source_(source), lookup_(lookup), tables_(tables) {}

  Program run(const SyntaxTree& tree, ExpectedType expected) {
    for (const SyntaxTree::Node& node : tree.nodes) stack_.push_back(value_of(tree, node));
    const Value& result = stack_.back();
    if (expected == ExpectedType::number) require_number(result);
    if (expected == ExpectedType::condition) require_condition(result);
    Program program = tape_.extract(result.node);
    program.text = source_.text;
    return program;
  }

 private:
  struct Value {
    TapeBuilder::Index node = 0;
    bool is_condition = false;
    std::size_t offset = 0;
  };

  Value value_of(const SyntaxTree& tree, const SyntaxTree::Node& node) {
    if (node.op == Operator::constant) return {tape_.constant(tree.numbers[node.item]), false, node.offset};
    if (node.op == Operator::variable && node.operands == 0) return name(tree.names[node.item], node.offset);
    const std::vector<Value> operands = take_operands(node.operands);
    if (node.op == Operator::variable)
      return call(*tables_.find(tree.names[node.item]), operands, node.offset);
    if (is_comparison(node.op)) return chain(tree, node, operands);
    check_types(node.op, operands);
    return {apply(node.op, operands), is_condition(node.op), node.offset};
  }

  std::vector<Value> take_operands(std::size_t count) {
    const auto first = stack_.end() - static_cast<std::ptrdiff_t>(count);
    std::vector<Value> operands(first, stack_.end());
    stack_.erase(first, stack_.end());
    return operands;
  }

  void check_types(Operator op, const std::vector<Value>& operands) const {
    for (std::size_t i = 0; i < operands.size(); ++i) {
      const bool wants_condition = is_condition(op) || (op == Operator::if_else && i == 0);
      if (wants_condition) {
        require_condition(operands[i]);
      } else {
        require_number(operands[i]);
      }
    }
  }

  TapeBuilder::Index apply(Operator op, const std::vector<Value>& operands) {
    if (operands.empty()) return tape_.apply(op);
    if (op == Operator::if_else) return tape_.apply(op, operands[0].node, operands[1].node, operands[2].node);
    if (is_unary_function(op) || op == Operator::logical_not) return tape_.apply(op, operands[0].node);
    // min and max take any number of arguments, and a plus sign is a sum of one.
    TapeBuilder::Index result = operands[0].node;
    for (std::size_t i = 1; i < operands.size(); ++i) result = tape_.apply(op, result, operands[i].node);
    return result;
  }

  /// a < b <= c as (a < b) and (b <= c).
  Value chain(const SyntaxTree& tree, const SyntaxTree::Node& node, const std::vector<Value>& operands) {
    for (const Value& operand : operands) require_number(operand);
    Value result{0, true, node.offset};
    for (std::size_t i = 0; i + 1 < operands.size(); ++i) {
      const TapeBuilder::Index link =
          tape_.apply(tree.comparisons[node.item + i], operands[i].node, operands[i + 1].node);
      result.node = i == 0 ? link : tape_.apply(Operator::logical_and, result.node, link);
    }
    return result;
  }

  /// The program of a table with the operands for its variables.
  Value call(const TableFunction& table, const std::vector<Value>& operands, std::size_t offset) {
    for (const Value& operand : operands) require_number(operand);
    std::vector<TapeBuilder::Index> here;
    here.reserve(table.value.nodes.size());
    for (const Program::Node& node : table.value.nodes) {
      const bool is_argument = node.op == Operator::variable;
      here.push_back(is_argument ? operands[node.a].node : tape_.copy(table.value, node, here));
    }
    return {here.back(), false, offset};
  }

  Value name(std::string_view name, std::size_t offset) {
    auto known = known_names_.find(name);
    if (known == known_names_.end()) known = known_names_.emplace(name, resolve(name, offset)).first;
    Value value = known->second;
    value.offset = offset;
    return value;
  }

  Value resolve(std::string_view name, std::size_t offset) {
    if (name == "pi") return {tape_.constant(exact(kPi)), false, offset};
    const Binding binding = lookup_(name);
    if (const auto* const slot = std::get_if<std::uint32_t>(&binding)) {
      return {tape_.variable(*slot), false, offset};
    }
    if (const auto* const value = std::get_if<Rational>(&binding))
      return {tape_.constant(*value), false, offset};
    if (const auto* const definition = std::get_if<std::shared_ptr<const Program>>(&binding)) {
      return {tape_.merge(**definition), (*definition)->is_condition(), offset};
    }
    // A constant of other languages is rather intended than a name that is spelt alike.
    const std::string suggestion = suggested_constant(name);
    const std::string& hint = suggestion.empty() ? std::get<NotDefined>(binding).hint : suggestion;
    source_.fail(fmt::format("{} is not defined{}", in_quotes(name), hint), offset);
  }

  void require_number(const Value& value) const {
    if (value.is_condition) source_.fail("expected a number, found a condition", value.offset);
  }
  void require_condition(const Value& value) const {
    if (!value.is_condition) source_.fail("expected a condition, found a number", value.offset);
  }

  const SourceText& source_;
  const Lookup& lookup_;
  const TableLookup& tables_;
  TapeBuilder tape_;
  std::vector<Value> stack_;
  std::unordered_map<std::string_view, Value> known_names_;
};

}  // namespace

std::vector<std::uint32_t> Program::variables() const {
  std::vector<std::uint32_t> slots;
  for (const Node& node : nodes) {
    if (node.op == Operator::variable) slots.push_back(node.a);
  }
  std::sort(slots.begin(), slots.end());
  return slots;
}

Program link(std::string_view text, const Lookup& lookup, const TableLookup& tables, ExpectedType expected,
             std::string_view where) {
  const SourceText source{text, where};
  return Linker(source, lookup, tables).run(parse(source, tables), expected);
}

Program link(std::string_view text, const Lookup& lookup, ExpectedType expected, std::string_view where) {
  return link(text, lookup, TableLookup{no_table}, expected, where);
}

std::vector<std::string> mentioned_names(std::string_view text, const TableLookup& tables,
                                         std::string_view where) {
  const SyntaxTree tree = parse(SourceText{text, where}, tables);
  std::vector<std::string> names;
  std::unordered_set<std::string_view> seen;
  for (const SyntaxTree::Node& node : tree.nodes) {
    if (node.op != Operator::variable || node.operands > 0) continue;
    const std::string_view name = tree.names[node.item];
    if (!is_reserved_name(name) && seen.insert(name).second) names.emplace_back(name);
  }
  return names;
}

std::vector<std::string> mentioned_names(std::string_view text, std::string_view where) {
  return mentioned_names(text, TableLookup{no_table}, where);
}

bool is_reserved_name(std::string_view name) {
  return find_function(name).has_value() ||
         std::find(kKeywords.begin(), kKeywords.end(), name) != kKeywords.end();
}

}  // namespace coordreq
