#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "answers/network/network_problem.hpp"
#include "base/thread_team.hpp"
#include "choices/projections.hpp"
#include "engine/wave.hpp"

namespace coordreq {

/// How the agents of a network choose.
enum class Agreement : std::uint8_t {
  none,     ///< any u in IND_C(x), or in A(x) if they act by rules
  safest,   ///< all connected: the u in C(x) from which the least level is highest; else as without agreement
  careful,  ///< see CarefulActions; if they do not act by rules
};

/// For each partition of a network the operator that finds the least level of f(x, u) under the worst u that
/// its agents may choose, for cells of K; 0 if a post is blocked, or u is forbidden by `allow`. Cells of a
/// goal that ends the task have kTop.
class ModeChoices {
 public:
  /// @pre unchecked: what the problem refers to outlives this object.
  ModeChoices(const NetworkProblem& problem, Agreement agreement, ThreadTeam& team);

  /// [partition] For levels that are 0 or kTop before the step. @pre unchecked: this object outlives them.
  template <class Level>
  [[nodiscard]] std::vector<std::unique_ptr<RowOperator<Level>>> operators(int workers) const;

 private:
  struct Partition {
    const ActionGrouping* grouping = nullptr;
    const Projections* projections = nullptr;  ///< null: agents agree
  };

  const CellSet& nonterminal_;  ///< the cells of K whose posts are looked at
  const CellSet* terminal_;
  std::deque<ActionGrouping> groupings_;
  std::deque<Projections> projections_;
  std::vector<Partition> partitions_;
};

}  // namespace coordreq
