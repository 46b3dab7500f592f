#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "answers/answers.hpp"
#include "base/thread_team.hpp"
#include "choices/projections.hpp"
#include "engine/engine_sizes.hpp"
#include "engine/pair_table.hpp"

namespace coordreq {

/// The rules of agents: for each a condition over its inputs and the states that it sees, or none.
struct AgentRules {
  const std::vector<std::optional<Program>>& conditions;  ///< [agent]
  std::string key;                                        ///< of `silence` under which the conditions stand
};

/// A(x) of classes that act by rules of their agents (contract, section 9): for each class the actions that
/// its agents' conditions permit and, if an agent has none, that are in the projection of C(x) on the class.
/// Joint inputs that `allow` forbids count as blocked, and so do cells in which a class has no action.
///
/// With the conditions of `then`, each agent in a class of its own, this is C'.
struct SilentActions {
  /// @pre unchecked: K is known; `cells` outlives this object. @param cells where A is required
  /// @throws SpecError naming the first grid point where a condition cannot be decided
  SilentActions(const Answers& answers, const AgentRules& rules,
                const std::vector<std::vector<std::int32_t>>& classes, const CellSet& cells,
                ThreadTeam& team);
  SilentActions(const SilentActions&) = delete;
  SilentActions& operator=(const SilentActions&) = delete;
  ~SilentActions() = default;

  std::vector<std::optional<PairTable>>
      tables;  ///< [agent] nothing: it has no condition, or one that permits all actions
  std::vector<std::atomic<std::int64_t>> without_action;  ///< [agent] see SilentRules
  ActionGrouping grouping;
  Projections projections;
};

/// A(x) in the modes of a network whose partition has more than one class, for agents that act by the
/// communication-loss rule there (contract, sections 9 and 10).
class RuleModes {
 public:
  /// @param partitions of the modes @pre the spec has a communication-loss rule. @pre unchecked: K is known
  /// @throws SpecError naming the first grid point where a condition cannot be decided
  RuleModes(const Answers& answers, const std::vector<const PartitionSpec*>& partitions, ThreadTeam& team);

  /// [partition] null where it has one class. They refer to this object.
  [[nodiscard]] const std::vector<const Projections*>& projections() const { return projections_; }

 private:
  std::deque<SilentActions> actions_;
  std::vector<const Projections*> projections_;
};

/// The most bytes, about, that SilentActions take beside ordinary projections.
[[nodiscard]] double silent_bytes(const EngineSizes& sizes, const std::vector<InputClass>& classes);

/// The classes of the partition in which each agent is by itself.
[[nodiscard]] std::vector<std::vector<std::int32_t>> agents_alone(const ProblemSpec& spec);

}  // namespace coordreq
