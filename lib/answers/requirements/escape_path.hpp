#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "answers/goal/answer.hpp"
#include "answers/ground.hpp"
#include "answers/invariance/invariance.hpp"
#include "answers/one_cell/cell_posts.hpp"
#include "answers/requirements/result_requirement.hpp"
#include "model/input_class.hpp"
#include "numeric/rational.hpp"

namespace coordreq {

/// How the system can get from a cell out of S although all agents do what is reasonable to them; or lose
/// time on the way to the goal, or never get there.
struct EscapePath {
  /// Visited; each but the first is in f(the cell before, the joint input before). One more than there are
  /// steps, unless the last action leads nowhere (`left_domain`, `unsafe_between_samples`, `not_allowed`).
  std::vector<std::int64_t> cells;
  std::vector<std::int64_t> joint_inputs;  ///< one a step
  std::vector<EscapePhase> phases;         ///< one a step
  EscapeEnd end = EscapeEnd::outside_safe_set;
  std::vector<DomainSide> sides;  ///< through which the last action leads, if `left_domain`
  std::int64_t followed = 0;      ///< steps from the start that the system itself can follow, see RealRun
};

/// What escapes are made of.
struct EscapeSets {
  const Ground* ground = nullptr;
  const Invariance* invariance = nullptr;
  /// Of the partition: its classes, and DelayLayers::layers_of. Not used outside K; may be missing if no path
  /// starts in K.
  std::vector<InputClass> classes;
  const LevelMap* layers_of = nullptr;
  /// Of a requirement about the goal: which, and of `min_approach_delay` the approach layers of the
  /// partition.
  RequirementKind kind = RequirementKind::min_delay;
  const Goal* goal = nullptr;
  const LevelMap* approach_of = nullptr;
  /// Of `min_blind_delay`, of the partition: blind delays, and B; else null.
  const LevelMap* blind_delay_of = nullptr;
  const LevelMap* blind_countdown_of = nullptr;
  /// Of `min_silence`, of the partition: which it is, L, and when what comes after leaves S if there is that;
  /// else null.
  const PartitionSpec* partition = nullptr;
  const LevelMap* silence_of = nullptr;
  const LevelMap* lost = nullptr;
  /// What comes after is not known step by step: the path ends where it is not safe, and all that `lost` has
  /// to tell of S is where that is.
  bool ends_after_silence = false;
  /// [dimension]: what one index adds to a cell's number, by which ties are broken.
  std::vector<std::int64_t> number_stride;
};

/// A shortest way out of S as the abstraction has it. Ways are many, and most are made of what its boxes add:
/// a car that brakes may stay in its cell of speed. So the system itself is followed from the start
/// (RealRun), and of equals the way comes first that it can follow longest (EscapeSearch); then the
/// lowest-numbered.
///
/// - From x in K with delay k, k + 1 steps lead out of K, and fewer cannot: each takes the lowest-numbered u
///   in IND_C(x) that may lead to delay k - 1, and there the lowest-numbered such cell. With k = 0 it is the
///   u that leads out of K to the least collision time, which is 0 where it is blocked, or forbidden.
/// - From x outside K, collision_time(x) steps lead out of S, the worst successor each time: C can do no
///   better. The lowest-numbered u, and the lowest-numbered successor, of those that are equal.
/// - `max_arrival`, from x in K: all take the lowest-numbered u of least worst arrival, the world the
///   lowest-numbered of the worst y, down to the goal; where it cannot be forced the lowest-numbered y
///   outside W, until a cell repeats.
/// - `min_approach_delay`, from x in W of approach delay k: k steps by u in IND_P, each to a y whose approach
///   delay is one less, then one to a y that is not nearer; from the goal on as from x in K above, from x in
///   K outside W as for `max_arrival`.
/// - `min_blind_delay`, from x in K of blind delay k: as from x in K above, but to a countdown of k - 1,
/// which
///   each step takes down by one; where it is 0 a class has no action for all that it may see, which is the
///   end (or out of K, if that is what follows there).
/// - `min_silence`, from x in K' of silence k: as from x in K above, but by u in A(x), out of K'; where A(x)
/// is
///   empty that is the end. With `then` u is in C'(x) from there on: the lowest-numbered that leaves S
///   soonest, and there the lowest-numbered such cell.
/// @pre unchecked: the delay of x is bounded, and known.
/// Cost: a look at every joint input in every step, and at every cell of each different post.
/// Of several processes together: each step is found by the one that owns the cell.
/// @param start the state that is followed; none: the centre of the cell
[[nodiscard]] EscapePath find_escape(const EscapeSets& sets, std::int64_t cell,
                                     const std::optional<std::vector<Rational>>& start = std::nullopt);

/// Follows the system itself from a cell; at each step all do what they do first on the shortest way out from
/// where it is (find_escape()), so that nothing about it is an enclosure. Of requirements about safety that
/// all agents see alike: `min_delay`, `invariant`, `min_silence`. It is looked at at the samples, also where
/// safety is asked for between them. Cost: as find_escape() for each step.
/// @returns after how many steps it has left K (`min_silence`: K'), or S where it begins outside; kNotLeft of
///   ResultPath if it does not within 1,000 steps (fewer where joint inputs are many), where no such way
///   leads on, or where it comes inside from outside
[[nodiscard]] std::int32_t follow_escape(const EscapeSets& sets, std::int64_t cell,
                                         const std::optional<std::vector<Rational>>& start = std::nullopt);

}  // namespace coordreq
