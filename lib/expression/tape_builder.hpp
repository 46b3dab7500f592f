#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "expression/node_index.hpp"
#include "expression/program.hpp"

namespace coordreq {

/// Builds the tape of a Program bottom-up. Equal nodes are stored once; operations on constants are carried
/// out where the result is exact, and stay operations where it is not, so that intervals can enclose it. `if`
/// with equal branches is that branch where its condition is defined everywhere: what reads the tape need not
/// know that no cell has to decide it.
class TapeBuilder {
 public:
  using Index = std::uint32_t;

  [[nodiscard]] Index constant(const Rational& value);
  [[nodiscard]] Index variable(std::uint32_t slot);
  [[nodiscard]] Index apply(Operator op, Index a = 0, Index b = 0, Index c = 0);
  /// A node of `program`, on this tape. @param here where the nodes before it are on this tape
  [[nodiscard]] Index copy(const Program& program, const Program::Node& node, const std::vector<Index>& here);
  /// The result of `program`, its nodes copied in.
  [[nodiscard]] Index merge(const Program& program);

  /// The tape of everything `result` needs; `text` is left empty.
  [[nodiscard]] Program extract(Index result) const;

 private:
  struct RationalHash {
    std::size_t operator()(const Rational& q) const;
  };

  Index insert(const Program::Node& node);
  Index insert_truth(bool value);
  Index modulo(Index a, Index b);
  std::optional<Index> fold(const Program::Node& node);
  std::optional<Index> fold_number(const Program::Node& node);
  std::optional<Index> fold_condition(const Program::Node& node);
  [[nodiscard]] const Rational* constant_at(Index index) const;
  [[nodiscard]] std::optional<bool> truth_at(Index index) const;
  [[nodiscard]] bool is_total(const Program::Node& node) const;

  std::vector<Program::Node> nodes_;
  std::vector<bool> total_;  ///< whether a node is seen to be defined everywhere
  std::vector<Rational> constants_;
  NodeIndex index_of_node_;
  std::unordered_map<Rational, Index, RationalHash> index_of_constant_;
};

}  // namespace coordreq
