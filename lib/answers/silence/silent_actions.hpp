#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "answers/answers.hpp"
#include "answers/layers/projections.hpp"
#include "base/thread_team.hpp"
#include "engine/engine_sizes.hpp"
#include "engine/pair_table.hpp"

namespace coordreq {

/// What agents are told to do: for each a condition over its inputs and the states that it sees, or none.
struct AgentRules {
  const std::vector<std::optional<Program>>& conditions;  ///< [agent]
  std::string key;                                        ///< of `silence` that they stand under
};

/// A(x) of classes that act by rules of their agents (contract, section 9): of each class what its agents'
/// conditions permit and, if one of them has none, is in the projection of C(x) on the class. What `allow`
/// forbids counts as blocked, and so do cells in which a class has nothing that it may do.
///
/// With all conditions of all agents, each in a class of its own, the same is C' of `then`.
struct SilentActions {
  /// @pre unchecked: K is known; `cells` outlives this object. @param cells where A is asked for
  /// @throws SpecError naming the first grid point where a condition cannot be decided
  SilentActions(const Answers& answers, const AgentRules& rules,
                const std::vector<std::vector<std::int32_t>>& classes, const CellSet& cells,
                ThreadTeam& team);
  SilentActions(const SilentActions&) = delete;
  SilentActions& operator=(const SilentActions&) = delete;
  ~SilentActions() = default;

  std::vector<std::optional<PairTable>>
      tables;  ///< [agent] none: it has no condition, or one that permits all
  std::vector<std::atomic<std::int64_t>> lacking;  ///< [agent] see SilentRules
  ActionGrouping grouping;
  Projections projections;
};

/// What SilentActions take beside ordinary projections, at about the most.
[[nodiscard]] double silent_bytes(const EngineSizes& sizes, const std::vector<InputClass>& classes);

/// Each agent by itself, as classes of a partition are told.
[[nodiscard]] std::vector<std::vector<std::int32_t>> agents_alone(const ProblemSpec& spec);

}  // namespace coordreq
