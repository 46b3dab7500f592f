#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

// A counterexample as results files and reports have it.
namespace coordreq {

/// How agents choose at a step of a counterexample.
enum class PathPhase : std::uint8_t {
  independent,  ///< in K: each class picks from its projection of C(x), so that u is in IND_C(x)
  /// Outside K: the allowed joint action that delays the collision longest; if the controller is `given`, the
  /// one of its choices that delays it least.
  evasive,
  together,     ///< on the way to the goal: the joint action from which it can be forced soonest
  approaching,  ///< on the way to the goal: each class picks from its projection of P(x), so that u is in
                ///< IND_P(x)
  silent,       ///< in K': agents act by rules, so that u is in A(x)
  afterwards,   ///< outside K': agents act by `then`, so that u is in C'(x)
};

/// How a counterexample ends.
enum class PathEnd : std::uint8_t {
  outside_safe_set,        ///< the last cell is not in S
  left_domain,             ///< the last action leads out of the domain through an unsafe side
  unsafe_between_samples,  ///< the last action's way between the samples is not safe
  no_allowed_action,       ///< in the last cell, outside K, no joint input is allowed
  arrived,                 ///< in the goal, later than required
  never_arrives,           ///< a cell comes again, or the post has left safely: the goal cannot be forced
  time_lost,               ///< the last cell is not nearer to the goal than the one before
  not_allowed,             ///< each class may take its part of the last action, and `allow` forbids the whole
  too_risky,               ///< the path is one cell, of too great a risk
  no_common_action,  ///< in the last cell, in K, some class has no action for all cells that it may be in
  no_silent_action,  ///< in the last cell the rules leave some agent no action
};

/// One end of one state.
struct ResultSide {
  std::size_t state = 0;
  bool above = false;
  [[nodiscard]] bool operator==(const ResultSide&) const = default;
};

/// A counterexample with states, inputs and values of its cells. Samples are the cells visited, each but the
/// first in f(cell before, joint input before); steps lie between them, or follow the last one if the last
/// action leads to no cell.
struct ResultPath {
  std::vector<std::uint64_t> cell;  ///< [sample] row-major linear index
  std::vector<double> state;        ///< [sample, state] centre of the cell
  /// [sample] as in `/delay`, for `invariant` the delay of all agents together; for requirements about the
  /// goal arrivals or approach delays.
  std::vector<std::int32_t> delay;
  std::vector<std::int32_t> collision_time;  ///< [sample] as in `/collision_time`, INT32_MAX in K
  std::vector<double> input;                 ///< [step, input]
  std::vector<PathPhase> phase;              ///< [step]
  PathEnd end = PathEnd::outside_safe_set;
  std::optional<ResultSide> left_side;  ///< if `left_domain`: the first side

  static constexpr std::int32_t kNotFollowed = 0, kNotLeft = -1;
  /// The number of steps after which a nominal simulation leaves K (`min_silence`: K'), or S if it begins
  /// outside; kNotLeft if it does not; kNotFollowed if none is made.
  std::int32_t seen = kNotFollowed;

  [[nodiscard]] std::size_t samples() const { return cell.size(); }
  [[nodiscard]] std::size_t steps() const { return phase.size(); }
  [[nodiscard]] bool operator==(const ResultPath&) const = default;
};

}  // namespace coordreq
