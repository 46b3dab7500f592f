#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "expression/functions.hpp"
#include "expression/program.hpp"

namespace coordreq {

/// Several equations as one tape, each common sub-expression once, together with the rules by which Taylor
/// coefficients of every node follow from those of others (Moore 1966; Griewank and Walther 2008, ch. 13).
///
/// Invariants: value operands a, b, c stand before the nodes that use them; the series operands p, q of
/// `chain` and `inverse_chain` may stand behind, as only their lower orders are needed. Immutable, so safe
/// to share between threads.
struct FlowTape {
  /// How coefficient k of a node follows; `variable`: of state p, or of a disturbance (p = kNone), which is
  /// constant.
  using Rule = SeriesRule;
  static constexpr std::uint32_t kNone = 0xffffffff;

  struct Node {
    Operator op;
    std::uint32_t a = 0, b = 0, c = 0;  ///< as in Program::Node
    Rule rule = Rule::fixed;
    std::uint32_t p = 0, q = 0;
    std::uint32_t square = 0;  ///< of `angle`: p^2 + q^2; may stand behind

    /// Whether it depends on the box what the node amounts to.
    [[nodiscard]] bool is_choice() const { return rule == Rule::pick || rule == Rule::angle; }
  };

  std::vector<Node> nodes;
  std::vector<Rational> constants;
  std::vector<std::uint32_t> state_slots;   ///< in the order of the equations
  std::vector<std::uint32_t> outputs;       ///< node of each equation, then of each tangent
  std::vector<std::uint32_t> fixed_values;  ///< nodes without moving variables, ascending
  std::vector<std::uint32_t> values;        ///< moving nodes that the equations' values need, ascending
  std::vector<std::vector<std::uint32_t>> values_of;  ///< those that each of them needs
  std::vector<std::uint32_t> series;  ///< moving nodes that Taylor coefficients need, ascending
  bool affine = true;                 ///< each equation has degree at most 1 in the moving variables

  /// @param states slots of the states, in the order of the equations
  /// @param disturbances slots of the other moving variables
  FlowTape(std::span<const Program* const> equations, std::span<const std::uint32_t> states,
           std::span<const std::uint32_t> disturbances);
  /// The same together with e' = J(x) e, which a small difference e of two solutions obeys: as many states
  /// more, in the slots `tangents`. Nothing if an equation has a kink or may jump.
  [[nodiscard]] static std::optional<FlowTape> with_tangents(std::span<const Program* const> equations,
                                                             std::span<const std::uint32_t> states,
                                                             std::span<const std::uint32_t> tangents);

 private:
  FlowTape() = default;
  template <class Writer>
  void list_nodes(const Writer& writer);
};

}  // namespace coordreq
