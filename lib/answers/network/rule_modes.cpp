#include "answers/network/rule_modes.hpp"

#include "answers/invariance/answer.hpp"
#include "answers/network/network_problem.hpp"
#include "base/requires.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

RuleModes::RuleModes(const Answers& answers, ThreadTeam& team) {
  const ProblemSpec& spec = answers.context.spec;
  REQUIRES(spec.network.has_value() && spec.silence.has_value());
  for (const PartitionSpec* const partition : network_partitions(*spec.network)) {
    projections_.push_back(nullptr);
    if (partition->classes.size() < 2) continue;
    actions_.emplace_back(answers, AgentRules{spec.silence->actions, "actions"}, partition->classes,
                          *answers.get<NonterminalController>().controller.invariant, team);
    projections_.back() = &actions_.back().projections;
  }
}

}  // namespace coordreq
