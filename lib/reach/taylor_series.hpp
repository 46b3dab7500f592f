#pragma once

#include <span>
#include <vector>

#include "base/requires.hpp"
#include "reach/ball.hpp"
#include "reach/tape_values.hpp"

namespace coordreq {

/// Taylor coefficients x^[k] = x^(k) / k! of the solutions of an autonomous smooth system through a box,
/// by interval automatic differentiation along the tape: coefficient(i, k) encloses x_i^[k] at every point of
/// the box. Over an a-priori enclosure that is Lagrange's remainder: h^p x_i^[p] with x somewhere on the way.
///
/// Over-approximates. Scratch memory, use one a thread; cost O(order^2) a product node.
class TaylorSeries {
 public:
  /// @pre unchecked: the tape outlives it.
  TaylorSeries(const FlowTape& tape, std::size_t largest_order);

  /// Starts at order 0.
  /// @param slots the box: states, disturbances (constant) and all else
  /// @param fixed values of the nodes that do not move
  /// @param choices decided for a box that contains this one; no kink undecided
  /// @param held held[i] says that state i is kept constant
  void start(std::span<const Interval> slots, const TapeValues<Interval>& fixed, const Choices& choices,
             const std::vector<bool>& held);

  /// Adds the next order. @pre order() < largest_order()
  void extend();

  [[nodiscard]] std::size_t order() const { return order_; }
  [[nodiscard]] std::size_t largest_order() const { return stride_ - 1; }
  /// @pre k <= order()
  [[nodiscard]] const Ball& coefficient(std::size_t state, std::size_t k) const {
    REQUIRES(k <= order_);
    return states_[state * stride_ + k];
  }
  /// sum of coefficient(state, k) duration^k over k < order.
  [[nodiscard]] Ball polynomial(std::size_t state, std::size_t order, const Ball& duration) const;

 private:
  [[nodiscard]] Ball& at(std::uint32_t node, std::size_t k) { return nodes_[node * stride_ + k]; }
  [[nodiscard]] bool moves(std::uint32_t node) const {
    return tape_->nodes[node].rule != FlowTape::Rule::fixed;
  }
  [[nodiscard]] Interval value_of(std::uint32_t i, std::span<const Interval> slots) const;
  [[nodiscard]] bool is_pinned_angle(std::uint32_t i) const;
  [[nodiscard]] Interval picked_value(std::uint32_t i) const;
  [[nodiscard]] Ball picked(std::uint32_t i, std::size_t k);
  [[nodiscard]] Ball next(std::uint32_t i, std::size_t k);
  [[nodiscard]] Ball convolution(std::uint32_t p, std::uint32_t q, std::size_t k, std::size_t first,
                                 std::size_t last);
  [[nodiscard]] Ball square(std::uint32_t p, std::size_t k);
  [[nodiscard]] Ball quotient(std::uint32_t i, std::size_t k);
  [[nodiscard]] Ball chain(std::uint32_t i, std::size_t k);
  [[nodiscard]] Ball inverse_chain(std::uint32_t i, std::size_t k);
  [[nodiscard]] Ball power(std::uint32_t i, std::size_t k);
  [[nodiscard]] Ball angle(std::uint32_t i, std::size_t k);
  void set_state_coefficients(std::size_t k);

  const FlowTape* tape_;
  const Choices* choices_ = nullptr;
  const std::vector<bool>* held_ = nullptr;
  std::size_t stride_;
  std::size_t order_ = 0;
  std::vector<Interval> values_;           ///< order 0 of every node
  std::vector<Ball> nodes_;                ///< [node][order]
  std::vector<Ball> states_;               ///< [state][order]
  std::vector<std::size_t> last_nonzero_;  ///< a node: beyond it all coefficients so far are 0
};

}  // namespace coordreq
