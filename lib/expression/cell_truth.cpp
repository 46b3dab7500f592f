#include "expression/cell_truth.hpp"

#include <algorithm>
#include <utility>

#include "expression/tape_builder.hpp"

namespace coordreq {
namespace {

/// Bytes of a comparison; more is not remembered, for no estimate counts it.
constexpr std::int64_t kMostRemembered = std::int64_t{1} << 21U;

/// Which nodes are joined to the result by `and`, `or` and `not`.
std::vector<bool> joined_nodes(const Program& condition) {
  std::vector<bool> joined(condition.nodes.size(), false);
  joined.back() = true;
  for (std::size_t i = joined.size(); i-- > 0;) {
    const Program::Node& node = condition.nodes[i];
    if (!joined[i] || is_comparison(node.op)) continue;
    if (operand_count(node.op) > 0) joined[node.a] = true;
    if (operand_count(node.op) > 1) joined[node.b] = true;
  }
  return joined;
}

}  // namespace

bool may_not_know(const Program& condition) {
  return std::any_of(condition.nodes.begin(), condition.nodes.end(),
                     [](const Program::Node& node) { return node.op == Operator::literal_undecided; });
}

CellTruth::Comparison::Comparison(Program condition)
    : program(std::move(condition)), decider(program), variables(program.variables()) {}

CellTruth::CellTruth(const Program& condition, std::vector<ConditionAxis> axes)
    : axes_(std::move(axes)), exact_(axes_.size()), fast_(axes_.size()) {
  const std::vector<bool> joined = joined_nodes(condition);
  TapeBuilder tape;
  std::vector<TapeBuilder::Index> here;
  std::vector<std::uint32_t> number(condition.nodes.size(), 0);
  for (std::size_t i = 0; i < condition.nodes.size(); ++i) {
    const Program::Node& node = condition.nodes[i];
    here.push_back(tape.copy(condition, node, here));
    if (!joined[i]) continue;
    number[i] = static_cast<std::uint32_t>(nodes_.size());
    if (!is_comparison(node.op)) {
      nodes_.push_back({node.op, number[node.a], number[node.b]});
      continue;
    }
    nodes_.push_back({node.op, static_cast<std::uint32_t>(comparisons_.size())});
    Comparison& comparison = comparisons_.emplace_back(tape.extract(here.back()));
    std::int64_t size = 1;
    for (const std::uint32_t slot : comparison.variables)
      size = size > kMostRemembered ? size : size * axes_[slot].count;
    if (size <= kMostRemembered) comparison.known.assign(static_cast<std::size_t>(size), 0);
  }
  truths_.resize(nodes_.size());
}

Truth CellTruth::at(std::span<const std::int64_t> indices) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (is_comparison(node.op)) {
      truths_[i] = of(comparisons_[node.a], indices);
    } else if (node.op == Operator::logical_not) {
      truths_[i] = !truths_[node.a];
    } else if (node.op == Operator::logical_and) {
      truths_[i] = truth_and(truths_[node.a], truths_[node.b]);
    } else if (node.op == Operator::logical_or) {
      truths_[i] = truth_or(truths_[node.a], truths_[node.b]);
    } else {
      const bool is_open = node.op == Operator::literal_undecided;
      truths_[i] = is_open ? Truth::undecided : to_truth(node.op == Operator::literal_true);
    }
  }
  return truths_.back();
}

Truth CellTruth::of(Comparison& comparison, std::span<const std::int64_t> indices) {
  if (comparison.known.empty()) return decide(comparison, indices);
  std::int64_t number = 0;
  for (const std::uint32_t slot : comparison.variables) number = number * axes_[slot].count + indices[slot];
  std::uint8_t& known = comparison.known[static_cast<std::size_t>(number)];
  if (known == 0) known = static_cast<std::uint8_t>(1 + static_cast<int>(decide(comparison, indices)));
  return static_cast<Truth>(known - 1);
}

Truth CellTruth::decide(Comparison& comparison, std::span<const std::int64_t> indices) {
  std::vector<ConditionAxis::Ranges> ranges;
  std::vector<std::size_t> piece(comparison.variables.size(), 0);
  for (const std::uint32_t slot : comparison.variables) ranges.push_back(axes_[slot].ranges(indices[slot]));
  const auto truth_of_pieces = [&] {
    for (std::size_t v = 0; v < piece.size(); ++v) {
      exact_[comparison.variables[v]] = ranges[v][piece[v]];
      fast_[comparison.variables[v]] = enclose(ranges[v][piece[v]]);
    }
    return comparison.decider.decide(std::span<const Interval>(fast_),
                                     [&] { return std::span<const RationalInterval>(exact_); });
  };
  const auto advance = [&] {
    for (std::size_t v = 0; v < piece.size(); ++v) {
      if (++piece[v] < ranges[v].size()) return true;
      piece[v] = 0;
    }
    return false;
  };
  const Truth truth = truth_of_pieces();
  while (advance()) {
    if (truth_of_pieces() != truth) return Truth::undecided;
  }
  return truth;
}

}  // namespace coordreq
