#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "answers/field_source.hpp"
#include "spec/spec_types.hpp"

// Requirements, their verdicts and counterexamples, as in results files and reports.
namespace coordreq {

/// How agents choose at a step of an escape.
enum class EscapePhase : std::uint8_t {
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

/// How an escape ends.
enum class EscapeEnd : std::uint8_t {
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

/// An EscapePath with states, inputs and delays. Samples are the cells visited; steps lie between them, or
/// follow the last one.
struct ResultPath {
  std::vector<std::uint64_t> cell;  ///< [sample] row-major linear index
  std::vector<double> state;        ///< [sample, state] centre of the cell
  /// [sample] as in `/delay`, for `invariant` the delay of all agents together; for requirements about the
  /// goal arrivals or approach delays.
  std::vector<std::int32_t> delay;
  std::vector<std::int32_t> collision_time;  ///< [sample] as in `/collision_time`, INT32_MAX in K
  std::vector<double> input;                 ///< [step, input]
  std::vector<EscapePhase> phase;            ///< [step]
  EscapeEnd end = EscapeEnd::outside_safe_set;
  std::optional<ResultSide> left_side;  ///< if `left_domain`: the first side

  static constexpr std::int32_t kNotFollowed = 0, kNotLeft = -1;
  /// The number of steps after which the system itself leaves, see follow_escape().
  std::int32_t seen = kNotFollowed;

  [[nodiscard]] std::size_t samples() const { return cell.size(); }
  [[nodiscard]] std::size_t steps() const { return phase.size(); }
  [[nodiscard]] bool operator==(const ResultPath&) const = default;
};

/// Whether the system itself is followed from where a counterexample begins: for requirements about safety in
/// which agents see everything.
[[nodiscard]] bool is_followed(RequirementKind kind, const ResultPath& path);

struct ResultRequirement {
  std::string name;
  bool holds = false;
  std::uint64_t cells = 0;    ///< of the region
  std::uint64_t failing = 0;  ///< cells of the region that fail
  /// Over the region, coded as in `/delay` with INT32_MAX: unbounded; likewise the greatest arrival or the
  /// least approach delay.
  std::int32_t least_delay = 0;
  /// For `max_risk` `least_delay`, and the delays of the path, are risks as bits of a float32, which order
  /// like the numbers; this is the greatest risk with the part of the rate for the steps, which is compared.
  double risk = 0;
  bool is_risk = false;
  std::optional<ResultSide> reached_side;  ///< a side beyond which the region may reach
  std::optional<ResultPath> path;          ///< from the worst cell, if a cell fails

  [[nodiscard]] bool operator==(const ResultRequirement&) const = default;
};

/// [requirement of the spec] The verdicts in a file. @throws ResultsError if verdicts and counterexamples do
/// not fit together
[[nodiscard]] std::vector<ResultRequirement> read_requirement_values(const ProblemSpec& spec,
                                                                     const FieldSource& source);

/// The path of a field of all requirements, and that of a field of the counterexample of one.
[[nodiscard]] std::string counterexample_path(const std::string& name);
[[nodiscard]] std::string counterexample_path(std::size_t requirement, const std::string& name);

}  // namespace coordreq
