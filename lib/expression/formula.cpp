#include "expression/formula.hpp"

#include <utility>

#include "base/requires.hpp"
#include "expression/tape_builder.hpp"

namespace coordreq {
namespace {

class Dismantler {
 public:
  explicit Dismantler(const Program& condition) : condition_(condition) {}

  Formula run() {
    const auto size = condition_.nodes.size();
    formula_index_.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      tape_index_.push_back(tape_.copy(condition_, condition_.nodes[i], tape_index_));
      if (is_condition(condition_.nodes[i].op)) add(i);
    }
    return std::move(formula_);
  }

 private:
  /// Conditions inside of numbers (of `if`) come along too; they are in no way of the result.
  void add(std::size_t i) {
    const Program::Node& node = condition_.nodes[i];
    formula_index_[i] = static_cast<std::uint32_t>(formula_.nodes.size());
    if (!is_comparison(node.op)) {
      formula_.nodes.push_back({node.op, formula_index_[node.a], formula_index_[node.b]});
      return;
    }
    const auto number = static_cast<std::uint32_t>(formula_.comparisons.size());
    const auto difference = tape_.apply(Operator::subtract, tape_index_[node.a], tape_index_[node.b]);
    formula_.comparisons.push_back({node.op, tape_.extract(difference)});
    formula_.nodes.push_back({Operator::less, number, 0});
  }

  const Program& condition_;
  TapeBuilder tape_;
  std::vector<TapeBuilder::Index> tape_index_;
  std::vector<std::uint32_t> formula_index_;
  Formula formula_;
};

}  // namespace

Truth Formula::value(std::span<const Truth> truths) const {
  std::vector<Truth> values;
  values.reserve(nodes.size());
  for (const Node& node : nodes) {
    switch (node.op) {
      case Operator::logical_and:
        values.push_back(truth_and(values[node.a], values[node.b]));
        break;
      case Operator::logical_or:
        values.push_back(truth_or(values[node.a], values[node.b]));
        break;
      case Operator::logical_not:
        values.push_back(!values[node.a]);
        break;
      case Operator::literal_true:
      case Operator::literal_false:
        values.push_back(to_truth(node.op == Operator::literal_true));
        break;
      case Operator::literal_undecided:
        values.push_back(Truth::undecided);
        break;
      default:
        values.push_back(truths[node.a]);
    }
  }
  return values.back();
}

Formula take_apart(const Program& condition) {
  REQUIRES(condition.is_condition());
  return Dismantler(condition).run();
}

}  // namespace coordreq
