#pragma once

#include <span>
#include <vector>

#include "base/requires.hpp"
#include "reach/ball.hpp"
#include "reach/tape_values.hpp"
#include "reach/taylor_kernels.hpp"

namespace coordreq {

/// Taylor coefficients x^[k] = x^(k) / k! of the solutions of an autonomous smooth system through boxes, by
/// interval automatic differentiation along the tape: coefficient(l, i, k) encloses x_i^[k] at every point of
/// box l. Over an a-priori enclosure that is Lagrange's remainder: h^p x_i^[p] with x somewhere in it.
///
/// A few boxes side by side, in lanes of vectors, take no longer than one (taylor_kernels.hpp).
///
/// Over-approximates. Scratch memory, use one a thread; cost O(order^2) a product node.
class TaylorSeries {
 public:
  static constexpr std::size_t kLanes = BallLanes::kLanes;

  /// @pre unchecked: the tape outlives it.
  TaylorSeries(const FlowTape& tape, std::size_t largest_order);

  /// Starts at order 0, with no box yet.
  /// @param fixed values of the nodes that do not move
  /// @param choices decided for a box that contains all that follow; no kink undecided
  /// @param held held[i] says that state i is kept constant
  void start(const TapeValues<Interval>& fixed, const Choices& choices, const std::vector<bool>& held);
  /// Adds a box. @pre lanes() < kLanes, and order() is 0
  /// @param slots the box: states, disturbances (constant) and all else
  /// @param known if not null: values of the tape over it, without pins
  void add_box(std::span<const Interval> slots, const TapeValues<Interval>* known = nullptr);

  /// Adds the next order. @pre order() < largest_order() and lanes() > 0
  void extend();

  [[nodiscard]] std::size_t lanes() const { return memory_.lanes; }
  [[nodiscard]] std::size_t order() const { return order_; }
  [[nodiscard]] std::size_t largest_order() const { return memory_.stride - 1; }
  /// @pre lane < lanes() and k <= order()
  [[nodiscard]] Ball coefficient(std::size_t lane, std::size_t state, std::size_t k) const {
    REQUIRES(lane < lanes() && k <= order_);
    const BallLanes& balls = states_[state * memory_.stride + k];
    return {balls.middle[lane], balls.radius[lane]};
  }
  /// sum of coefficient(lane, state, k) duration^k over k < order, of each lane.
  [[nodiscard]] BallLanes polynomials(std::size_t state, std::size_t order, const Ball& duration) const;

 private:
  [[nodiscard]] SeriesNode node_of(std::uint32_t i) const;
  [[nodiscard]] bool moves(std::uint32_t node) const {
    return tape_->nodes[node].rule != FlowTape::Rule::fixed;
  }
  void mark_weighted();
  void allocate();
  void make_choice(SeriesNode& node) const;
  void put_values(std::size_t lane);
  [[nodiscard]] Interval value_of(std::uint32_t i, std::span<const Interval> slots) const;
  [[nodiscard]] bool is_pinned_angle(std::uint32_t i) const;
  [[nodiscard]] Interval picked_value(std::uint32_t i) const;

  const FlowTape* tape_;
  const TaylorKernels* kernels_;
  const Choices* choices_ = nullptr;
  std::size_t order_ = 0;
  std::vector<SeriesNode> nodes_;          ///< that move, in the order of the tape
  std::vector<std::size_t> choice_nodes_;  ///< those of them that are choices
  std::vector<bool> has_value_;            ///< of each node of the tape: it is among its values
  std::vector<SeriesOutput> outputs_;
  std::vector<Interval> values_;  ///< order 0 of every node, over the last box
  std::vector<BallLanes> coefficients_;
  std::vector<BallLanes> weighted_;
  std::vector<BallLanes> states_;
  std::vector<std::uint32_t> last_nonzero_;
  SeriesMemory memory_;
};

}  // namespace coordreq
