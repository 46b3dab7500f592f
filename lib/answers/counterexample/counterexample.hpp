#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "answers/analysis_context.hpp"
#include "answers/counterexample/result_path.hpp"
#include "engine/level_map.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// For how many steps something is kept from a cell on: 0: it is lost there, INT64_MAX: it never is.
using StepsFrom = std::function<std::int64_t(std::int64_t cell)>;
using IsCell = std::function<bool(std::int64_t cell)>;

/// The levels of a map as steps. @pre unchecked: the map outlives it
[[nodiscard]] StepsFrom steps_from(const LevelMap& levels);
/// Whether cells are in a set. @pre unchecked: the set outlives it
[[nodiscard]] IsCell is_in(const CellSet& set);

/// A part of a counterexample in which agents choose alike, and a number of steps falls by one with each.
struct CounterexamplePhase {
  PathPhase choices = PathPhase::evasive;
  IsCell holds;     ///< whether the phase holds at a cell; where it does not the next one begins
  StepsFrom steps;  ///< falls by one with each step
  /// Where one step is left: the last step of the phase leads to the least of these. Empty: `steps` falls to
  /// 0.
  StepsFrom after = nullptr;
  /// At the first cell of the path, instead of `steps`: agents who see only themselves know that cell.
  StepsFrom first = nullptr;
  /// Whether some class has no action at a later cell, for all cells that it may be in; empty: nowhere.
  IsCell has_no_action = nullptr;
};

/// The inputs to find a counterexample.
struct CounterexampleProblem {
  const AnalysisContext* context = nullptr;
  IsCell invariant;          ///< K
  StepsFrom collision_time;  ///< 0 outside S
  /// The value by which a cell is judged, as in ResultPath::delay.
  std::function<std::int32_t(std::int64_t cell)> value;
  /// In this order. The path ends where the last one does; with none it is one cell.
  std::vector<CounterexamplePhase> phases;
  const PartitionSpec* partition = nullptr;  ///< null: all agents together
  /// The set that nominal simulations leave: K, or K'. Empty: none is made.
  IsCell inside = nullptr;
  /// Steps to the goal as ProgressInputs::Arrival; used in the phases `together` and `approaching`.
  std::function<std::int32_t(std::int64_t cell)> arrival = nullptr;
  /// Of a lasting goal find_showing_order(), where a path may need it.
  StepsFrom showing_order = nullptr;
  /// [dimension] Distance of the numbers of cells from one index to the next; by numbers ties are broken.
  std::vector<std::int64_t> number_stride;
};

/// In K, by IND_C of a partition. @param steps of its layers
[[nodiscard]] CounterexamplePhase independent_phase(const CounterexampleProblem& problem, StepsFrom steps);
/// Outside K, in S.
[[nodiscard]] CounterexamplePhase evasive_phase(const CounterexampleProblem& problem);
/// In K', by the communication-loss rule. @param after by which steps are bad outside
[[nodiscard]] CounterexamplePhase silent_phase(StepsFrom steps, StepsFrom after);

/// A path of the system from a cell out of S although all agents choose admissible actions; or to lose time
/// before the goal, or never to arrive: a shortest one in the abstraction. There are many, and most exist
/// only because posts are boxes: a car that brakes may stay in its cell of speed. So the system itself is
/// followed from the start (NominalRun), and of equally short paths the one is taken that it can follow
/// longest (PathSearch), then the lowest-numbered.
///
/// - From x in K with delay k, k + 1 steps lead out of K, and fewer cannot: each takes the lowest-numbered u
///   in IND_C(x) that may lead to delay k - 1, and there the lowest-numbered such cell. With k = 0 it takes
///   the u that leads out of K to the least collision time, which is 0 if u is blocked or forbidden.
/// - From x outside K, collision_time(x) steps lead out of S, the worst successor each time: C can do no
///   better. Of equal u, and of equal successors, the lowest-numbered.
/// - `max_arrival`, from x in K: agents take the lowest-numbered u of least worst arrival, then comes the
///   lowest-numbered of the worst y, down to the goal; where the goal cannot be forced the lowest-numbered y
///   outside W, until a cell repeats. Of a lasting goal the worst y that comes first in find_showing_order()
///   (where the controller is `given`, of all u too); T through a `safe` side ends the path at once.
/// - `min_approach_delay`, from x in W of approach delay k: k steps by u in IND_P, each to a y whose approach
///   delay is one less, then one to a y that is not nearer, so that the step makes no progress; from the goal
///   on, which does not last, as from x in K above, from x in K outside W as for `max_arrival`.
/// - `min_blind_delay`, from x in K of blind delay k: as from x in K above, but to a countdown of k - 1,
///   which falls by one with each step; where it is 0 a class has no action for all cells that it may be
///   in, and the path ends (or it leads out of K, if a step does).
/// - `min_silence`, from x in K' of silence k: as from x in K above, but by u in A(x), out of K'; where
///   A(x) is empty the path ends. With `then` u is in C'(x) from there on: the lowest-numbered that leaves
///   S soonest, and there the lowest-numbered such cell.
///
/// A nominal simulation starts at the same state; at each step agents take the first action of such a path
/// from its present cell, so that no enclosure is involved. It is observed at the samples, also where safety
/// is required between them, and ends after 1,000 steps (fewer if there are many joint inputs), where no such
/// path leads on, or where it comes from outside K into K.
/// @pre unchecked: the steps of x are bounded, and known.
/// Cost: a look at every joint input in every step, and at every cell of each different post.
/// Of several processes together: each step is found by the one that owns the cell.
/// @param cell in the order of the grid of the abstraction
/// @param start the state from which the system itself is followed; nothing: the centre of the cell
[[nodiscard]] ResultPath find_counterexample(
    const CounterexampleProblem& problem, std::int64_t cell,
    const std::optional<std::vector<Rational>>& start = std::nullopt);

}  // namespace coordreq
