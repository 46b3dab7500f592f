#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "expression/program.hpp"
#include "spec/coordination_spec.hpp"
#include "spec/spec_types.hpp"
#include "spec/system_spec.hpp"

// The problem as plain data, contract section 2. Only read_spec() makes one, so every invariant named here
// holds wherever a ProblemSpec is seen.
namespace coordreq {

struct WrittenSpec;

struct ControllerSpec {
  Synthesis synthesis = Synthesis::maximal;
  /// Over states and inputs; none: everything is allowed. Grid points are asked; but conditions of memories
  /// that `safe` asks of whole cells have slots of their own for states, after those of states and inputs.
  std::optional<Program> allow;
  std::optional<std::string> file;  ///< as written; lists the pairs that are admissible
};

struct MemorySpec {
  std::string name;
  Program truth;  ///< its condition at a sample, over states
  std::vector<std::string>
      states;  ///< that keep it, among the last ones of ProblemSpec::states; perhaps none
};

/// The rules of agents while they are silent, and those that hold indefinitely if they never connect again:
/// conditions over inputs of the agent and states that it sees (contract, section 9), asked of grid points as
/// ControllerSpec::allow is.
struct SilenceSpec {
  std::vector<std::optional<Program>> actions;  ///< [agent]; none: what C leaves to its class
  std::vector<std::optional<Program>> then;  ///< [agent] all of them have one; or none has, and it is empty

  [[nodiscard]] bool has_then() const { return !then.empty(); }
};

struct RequirementSpec {
  std::string name;
  Program where;  ///< over states
  RequirementKind kind = RequirementKind::min_delay;
  std::optional<std::int32_t> partition;  ///< index into partitions; none where it is about all of them
  /// The steps that are required, 0 for `invariant`: of a least time ceil(time / period), of a greatest time
  /// floor(time / period). Of `max_risk` the number n of times that its rate is added.
  std::int64_t steps = 0;
  Rational risk = 0;  ///< of `max_risk`: the greatest risk
  std::string per;    ///< likewise, "s", "min" or "h"; empty: within the horizon

  [[nodiscard]] bool is_of_partition() const {
    return kind == RequirementKind::min_delay || kind == RequirementKind::min_approach_delay ||
           kind == RequirementKind::min_blind_delay || kind == RequirementKind::min_silence;
  }
};

struct OutputSpec {
  bool controller = false;
  bool actions = false;
  bool layers = false;
  bool abstraction = false;
};

struct ProblemSpec : SystemSpec {
  std::string text;  ///< the spec as read, UTF-8
  /// The spec as its author has written it, where that differs from `text`; null: it does not.
  std::shared_ptr<const WrittenSpec> written;
  std::string folder;  ///< where relative paths start; empty: the current one
  std::string name;
  std::string description;
  std::vector<MemorySpec> memory;  ///< in the order of the spec
  Program safe;                    ///< a condition over states
  std::optional<Program> goal;     ///< likewise
  GoalThen goal_then = GoalThen::safe;
  ControllerSpec controller;
  CoordinationSpec coordination;
  std::optional<NetworkSpec> network;
  std::optional<RiskSpec> risk;
  std::optional<SilenceSpec> silence;
  std::vector<RequirementSpec> requirements;
  OutputSpec output;

  /// The goal's cells count as T.
  [[nodiscard]] bool ends_at_goal() const { return goal_then == GoalThen::terminal; }
  /// The goal is one to stay at or to return to, and says what agents do in it (contract, section 11).
  [[nodiscard]] bool is_goal_lasting() const {
    return goal_then == GoalThen::stay || goal_then == GoalThen::come_back;
  }
};

}  // namespace coordreq
