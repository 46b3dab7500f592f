#include "answers/network/mode_choices.hpp"

#include <utility>

#include "answers/network/careful_actions.hpp"
#include "choices/independent_actions.hpp"
#include "choices/joint_actions.hpp"
#include "engine/sparing_operator.hpp"

namespace coordreq {
namespace {

/// Whether cells stay is known by levels of 8 bits, and how safe they are by wider ones.
///
/// The safest of all allowed u stands for that of C(x): one outside C(x) leads out of K, to the least level;
/// in K there is always one in C(x).
template <class Level>
std::unique_ptr<RowOperator<Level>> make_agreed(const ActionGrouping& grouping, int workers) {
  if constexpr (sizeof(Level) == 1) return std::make_unique<CarefulActions>(grouping, workers);
  // The operator of levels that rise looks at all cells, for any old levels.
  if constexpr (sizeof(Level) > 1) return std::make_unique<SomeAction<Level>>(grouping, true, workers);
}

}  // namespace

ModeChoices::ModeChoices(const NetworkProblem& problem, Agreement agreement, ThreadTeam& team)
    : nonterminal_(*problem.controller->invariant), terminal_(problem.terminal) {
  const Controller& controller = *problem.controller;
  for (std::size_t p = 0; p < problem.partitions.size(); ++p) {
    Partition& partition = partitions_.emplace_back();
    partition.projections = problem.rules[p];
    if (partition.projections != nullptr) continue;
    const std::vector<InputClass>& classes = problem.partitions[p];
    const bool is_safest = agreement == Agreement::safest && classes.size() == 1;
    partition.grouping = &groupings_.emplace_back(
        *controller.engine, is_safest ? single_classes(controller.engine->abstraction().inputs) : classes,
        team);
    if (!is_safest && agreement != Agreement::careful)
      partition.projections = &projections_.emplace_back(controller, *partition.grouping, team);
  }
}

template <class Level>
std::vector<std::unique_ptr<RowOperator<Level>>> ModeChoices::operators(int workers) const {
  std::vector<std::unique_ptr<RowOperator<Level>>> result;
  for (const Partition& partition : partitions_) {
    if (partition.projections == nullptr) {
      result.push_back(make_agreed<Level>(*partition.grouping, workers));
    } else {
      result.push_back(
          std::make_unique<IndependentActions<Level>>(*partition.projections, nonterminal_, workers));
    }
    if (terminal_ == nullptr) continue;
    result.back() = std::make_unique<SparingOperator<Level>>(std::move(result.back()), *terminal_, workers);
  }
  return result;
}

template std::vector<std::unique_ptr<RowOperator<std::uint8_t>>> ModeChoices::operators(int) const;
template std::vector<std::unique_ptr<RowOperator<std::uint32_t>>> ModeChoices::operators(int) const;
template std::vector<std::unique_ptr<RowOperator<std::uint64_t>>> ModeChoices::operators(int) const;

}  // namespace coordreq
