#pragma once

#include <stddef.h>
#include <stdint.h>

namespace coordreq {

/// How a kernel finds coefficient k of a node: as a SeriesRule says, with the choices of `pick` made.
enum class SeriesStep : uint8_t {
  zero,
  input,  ///< the coefficient of state p
  same,   ///< that of node p
  sum,
  difference,
  negation,
  product,
  quotient,
  chain,
  inverse_chain,
  root,
  power,
  angle,
};

/// A node whose coefficients are found, in the order of the tape.
struct SeriesNode {
  SeriesStep step = SeriesStep::zero;
  bool p_moves = false;  ///< whether operand p has coefficients beyond order 0
  bool q_moves = false;
  bool square_moves = false;
  bool weighted = false;  ///< j times coefficient j is asked for
  uint32_t self = 0;
  uint32_t p = 0;
  uint32_t q = 0;
  uint32_t square = 0;
};

/// Balls (see Ball) of series side by side.
struct BallLanes {
  static constexpr size_t kLanes = 4;
  alignas(32) double middle[kLanes] = {};
  alignas(32) double radius[kLanes] = {};
};

/// A state of series, which is the integral of a node.
struct SeriesOutput {
  uint32_t node = 0;
  bool moves = false;  ///< the node does
  bool held = false;   ///< it is kept constant
};

/// The memory of series side by side. Coefficient k of node i is at i * stride + k, of states likewise.
struct SeriesMemory {
  const SeriesNode* nodes = nullptr;
  size_t node_count = 0;
  const SeriesOutput* outputs = nullptr;
  size_t state_count = 0;
  size_t stride = 0;
  size_t lanes = 1;  ///< that are in use: the first ones
  BallLanes* coefficients = nullptr;
  BallLanes* weighted = nullptr;  ///< j times coefficient j, of nodes that are asked for it
  BallLanes* states = nullptr;
  /// Of each node: beyond it all coefficients so far are 0. As many for each part of the lanes.
  uint32_t* last_nonzero = nullptr;
  size_t tape_size = 0;  ///< number of all nodes
};

/// Operations on series side by side. Rounded to nearest.
struct TaylorKernels {
  /// Finds coefficient k of all nodes, if k > 0, and then k + 1 of all states.
  void (*extend)(const SeriesMemory& memory, size_t k);
  /// sum of coefficient k of a state times h^k over k < order. @param h the same ball in all lanes
  void (*polynomial)(const SeriesMemory& memory, size_t state, size_t order, const BallLanes& h,
                     BallLanes& sum);
};

/// The fastest ones for this processor. All give the same numbers.
[[nodiscard]] const TaylorKernels& taylor_kernels();
[[nodiscard]] const TaylorKernels& portable_taylor_kernels();

}  // namespace coordreq
