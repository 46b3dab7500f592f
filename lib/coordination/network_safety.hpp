#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/thread_team.hpp"
#include "bitset/cell_set.hpp"
#include "coordination/controller.hpp"
#include "safety/row_hull.hpp"
#include "safety/wave.hpp"

namespace coordreq {

/// One mode of a network: who is connected in a step, and which modes the next step can be in.
struct NetworkMode {
  std::size_t partition = 0;            ///< index into NetworkProblem::partitions
  std::vector<std::size_t> successors;  ///< indices of modes; at least one
};

struct NetworkProblem {
  const Controller* controller = nullptr;  ///< of K
  const RowHull* hull = nullptr;
  std::vector<std::vector<InputClass>> partitions;  ///< all different; the classes of each
  std::vector<NetworkMode> modes;
  bool resynthesise = false;
};

struct NetworkSafety {
  std::vector<CellSet> safe;  ///< [mode] W(q)
  WaveCounts counts;
};

/// From which cells the agents stay safe in each mode, whatever the network does from there on. With T(q) the
/// intersection of W(q') over the successors q' of q:
/// - usually the greatest W with W(q) = {x in K : empty != f(x,u) subset of T(q) for all u in IND_C(x)},
///   IND_C that of q's partition. The operator is monotone, so that any order of work gives the same;
/// - `resynthesise`: agents restrict themselves to C_q(x) = {u allowed : empty != f(x,u) subset of T(q)}.
/// From
///   W(q) = K on, synchronously, W(q) <- W(q) n {x : C_q(x) != empty, IND(C_q)(x) subset of C_q(x)} until
///   nothing changes. Sound, as the last W is a fixed point; perhaps not the largest, as the operator is not
///   monotone. Where everything is allowed it has all cells of the W above: at those C_q = C = IND_C in every
///   iteration, since T(q) lies between that of the W above and K.
///
/// Memory: a set of cells for each mode (`resynthesise`: up to two), a byte a cell, and the projections of C
/// for all partitions (`resynthesise`: none).
/// @param swept told after each sweep over the rows of a mode (number, rows visited); may be empty
[[nodiscard]] NetworkSafety find_network_safety(const NetworkProblem& problem,
                                                const std::function<void(std::int64_t, std::int64_t)>& swept,
                                                ThreadTeam& team);

}  // namespace coordreq
