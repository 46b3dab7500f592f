#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "answers/analysis_context.hpp"
#include "answers/goal/answer.hpp"
#include "answers/invariance/invariance.hpp"
#include "answers/one_cell/cell_posts.hpp"
#include "answers/requirements/result_requirement.hpp"
#include "model/input_class.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// A way of the system from a cell out of S although all agents choose admissible actions; or to lose time on
/// the way to the goal, or never to arrive.
struct EscapePath {
  /// The cells visited; each but the first is in f(cell before, joint input before). One more than steps,
  /// unless the last action leads to no cell (`left_domain`, `unsafe_between_samples`, `not_allowed`).
  std::vector<std::int64_t> cells;
  std::vector<std::int64_t> joint_inputs;  ///< one a step
  std::vector<EscapePhase> phases;         ///< one a step
  EscapeEnd end = EscapeEnd::outside_safe_set;
  std::vector<DomainSide> sides;  ///< through which the last action leads, if `left_domain`
  std::int64_t followed = 0;      ///< steps from the start that the system itself can follow, see RealRun
};

/// The inputs to find escapes.
struct EscapeSets {
  const AnalysisContext* context = nullptr;
  const Invariance* invariance = nullptr;
  /// The classes of the partition, and its DelayLayers::layers_of. Used in K alone; may be missing if no path
  /// starts in K.
  std::vector<InputClass> classes;
  const LevelMap* layers_of = nullptr;
  /// The kind of the requirement; for `min_approach_delay` also the approach layers of the partition.
  RequirementKind kind = RequirementKind::min_delay;
  const Goal* goal = nullptr;
  const LevelMap* approach_of = nullptr;
  /// Of a lasting goal find_showing_order(), where a path may need it; else null.
  const LevelMap* showing_order = nullptr;
  /// For `min_blind_delay` blind delays and B of the partition; else null.
  const LevelMap* blind_delay_of = nullptr;
  const LevelMap* blind_countdown_of = nullptr;
  /// For `min_silence` the partition, its L, and, if there is `then`, the times at which `then` leaves S;
  /// else null.
  const PartitionSpec* partition = nullptr;
  const LevelMap* silence_of = nullptr;
  const LevelMap* lost = nullptr;
  /// Steps by `then` are not known: the path ends at the first cell that is not safe, and `lost` is only used
  /// for that.
  bool ends_after_silence = false;
  /// [dimension] Distance of the numbers of cells from one index to the next; by numbers ties are broken.
  std::vector<std::int64_t> number_stride;
};

/// A shortest way out of S in the abstraction. There are many ways, and most exist only because posts are
/// boxes: a car that brakes may stay in its cell of speed. So the system itself is followed from the start
/// (RealRun), and of equally short ways the one is taken that it can follow longest (EscapeSearch), then the
/// lowest-numbered.
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
/// @pre unchecked: the delay of x is bounded, and known.
/// Cost: a look at every joint input in every step, and at every cell of each different post.
/// Of several processes together: each step is found by the one that owns the cell.
/// @param start the state from which the system itself is followed; nothing: the centre of the cell
[[nodiscard]] EscapePath find_escape(const EscapeSets& sets, std::int64_t cell,
                                     const std::optional<std::vector<Rational>>& start = std::nullopt);

/// Follows the system itself from a cell; at each step agents take the first action of the shortest way out
/// from its present cell (find_escape()), so that no enclosure is involved. For requirements about safety in
/// which agents see everything: `min_delay`, `invariant`, `min_silence`. The system is observed at the
/// samples, also where safety is asked for between them. Cost: as find_escape() for each step.
/// @returns the number of steps after which it has left K (`min_silence`: K'), or S if it begins outside K;
///   kNotLeft of ResultPath if it does not within 1,000 steps (fewer if there are many joint inputs), if no
///   such way leads on, or if it comes from outside K into K
[[nodiscard]] std::int32_t follow_escape(const EscapeSets& sets, std::int64_t cell,
                                         const std::optional<std::vector<Rational>>& start = std::nullopt);

}  // namespace coordreq
