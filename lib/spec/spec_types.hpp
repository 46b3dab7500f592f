#pragma once

#include <cstdint>
#include <string>

#include "numeric/rational.hpp"

// The words of a spec, and the names of its parts: all that most headers need to know of it. The parts are in
// system_spec.hpp and coordination_spec.hpp, the whole in problem_spec.hpp.
namespace coordreq {

struct ProblemSpec;
struct SystemSpec;
struct StateSpec;
struct InputSpec;
struct DisturbanceSpec;
struct AgentSpec;
struct DynamicsSpec;
struct AbstractionSpec;
struct ControllerSpec;
struct PartitionSpec;
struct LinkCostSpec;
struct CoordinationSpec;
struct NetworkSpec;
struct RiskSpec;
struct SilenceSpec;
struct MemorySpec;
struct RequirementSpec;
struct OutputSpec;

enum class Outside : std::uint8_t { unsafe, safe, saturate, stop, periodic, goal };
enum class Time : std::uint8_t { continuous, discrete };
enum class Cells : std::uint8_t { closed, half_open };
enum class Membership : std::uint8_t { inner, center };
enum class Synthesis : std::uint8_t { maximal, given };
/// What follows the arrival at a goal: nothing but safety, the end of the task, staying there, or visits
/// again and again.
enum class GoalThen : std::uint8_t { safe, terminal, stay, come_back };
enum class NetworkKind : std::uint8_t { automaton, delay, burst, weakly_hard, loss };
enum class RequirementKind : std::uint8_t {
  min_delay,
  invariant,
  min_silence,
  min_blind_delay,
  min_approach_delay,
  max_arrival,
  max_risk
};

/// The value of the key `then`.
[[nodiscard]] std::string goal_then_name(GoalThen then);
/// The key of the spec that stands for it, "automaton" for `modes`.
[[nodiscard]] std::string network_kind_name(NetworkKind kind);
/// The key of the spec that stands for it.
[[nodiscard]] std::string requirement_kind_name(RequirementKind kind);

/// The grid points first, first + step, ..., first + (count - 1) * step: count >= 1, step > 0.
struct GridSpec {
  Rational first;
  Rational step;
  std::int64_t count = 0;

  [[nodiscard]] Rational point(std::int64_t k) const { return first + step * Rational(static_cast<long>(k)); }
  [[nodiscard]] Rational last() const { return point(count - 1); }
};

}  // namespace coordreq
