#pragma once

#include <functional>
#include <vector>

#include "answers/network/network_problem.hpp"
#include "base/thread_team.hpp"
#include "engine/cell_set.hpp"
#include "engine/wave_watch.hpp"

namespace coordreq {

struct NetworkSafety {
  std::vector<CellSet> safe;  ///< [mode] W(q)
  WaveCounts counts;
};

/// Observes the sets while they shrink, and says where to take up work that was broken off.
struct NetworkWatch {
  /// As WaveWatch::step, after each sweep over the rows of a mode; the state is the sets of all modes. Where
  /// rounds are synchronous only a step at the end of a round has a state.
  std::function<void(const WaveStep&)> step;
  /// Sets that `step` was given; moved from. Null: begin with K.
  ///
  /// The result is the same. Usually the operator is monotone, and the sets lie above the greatest solution.
  /// For `resynthesise` they are those after a round, and the next round finds the same sets as without
  /// interruption: it computes every row, and a row that it would have passed over meets no change, so that
  /// it loses no cell.
  std::vector<CellSet>* resumed = nullptr;
};

/// From which cells the agents stay safe in each mode, whatever the network does from there on. With T(q) the
/// intersection of W(q') over the successors q' of q:
/// - usually the greatest W with W(q) = {x in K : empty != f(x,u) subset of T(q) for all u in IND_C(x)},
///   IND_C that of q's partition, and f(x,u) empty where u is forbidden (see ForbiddenChoices). The operator
///   is monotone, so that any order of work gives the same. Where agents act by rules, A(x) takes the place
///   of IND_C(x), and f(x,u) is empty, too, where a class has no action;
/// - `resynthesise`: agents restrict themselves to C_q(x) = {u allowed : empty != f(x,u) subset of T(q)}.
///   From W(q) = K on, synchronously, W(q) <- W(q) n {x : C_q(x) != empty, IND(C_q)(x) subset of C_q(x)}
///   until nothing changes. Sound, as the last W is a fixed point; perhaps not the largest, as the operator
///   is not monotone. Without a controller file it has all cells of the W above: there C_q = C = IND_C in
///   every iteration, since T(q) lies between the T(q) of the W above and K.
///
/// The cells of a goal that ends the task are in every W(q), and their posts are not looked at.
///
/// Memory: a set of cells for each mode (`resynthesise`: up to two), a byte a cell, and the projections of C
/// for all partitions (`resynthesise`: none).
[[nodiscard]] NetworkSafety find_network_safety(const NetworkProblem& problem, const NetworkWatch& watch,
                                                ThreadTeam& team);

}  // namespace coordreq
