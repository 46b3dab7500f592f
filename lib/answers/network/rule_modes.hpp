#pragma once

#include <deque>
#include <vector>

#include "answers/answers.hpp"
#include "answers/silence/silent_actions.hpp"
#include "base/thread_team.hpp"

namespace coordreq {

/// A(x) in modes of a network whose partition has more than one class, for agents that act by the
/// communication-loss rule there (contract, sections 9 and 10).
class RuleModes {
 public:
  /// @pre the spec has a network and a communication-loss rule. @pre unchecked: K is known
  /// @throws SpecError naming the first grid point where a condition cannot be decided
  RuleModes(const Answers& answers, ThreadTeam& team);

  /// [partition of network_partitions()] null where it has one class. They refer to this object.
  [[nodiscard]] const std::vector<const Projections*>& projections() const { return projections_; }

 private:
  std::deque<SilentActions> actions_;
  std::vector<const Projections*> projections_;
};

}  // namespace coordreq
