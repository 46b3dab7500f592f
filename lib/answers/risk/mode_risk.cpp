#include "answers/risk/mode_risk.hpp"

#include "choices/independent_actions.hpp"
#include "choices/joint_actions.hpp"

namespace coordreq {
namespace {

template <class Level>
class WorstRisk final : public ModeRisk<Level> {
 public:
  WorstRisk(const Projections& projections, const CellSet& invariant, int workers)
      : actions_(projections, invariant, workers) {}
  void find(const RowPlace& place, PostReader<Level>& posts, Level* next, int worker) override {
    actions_.find_minimum(place, posts, next, worker);
  }

 private:
  IndependentActions<Level> actions_;
};

/// The least risk over all allowed u instead of those of C(x): an allowed u outside C(x) leads out of K, and
/// no risk is greater than its risk; in K there is always an u of C(x).
template <class Level>
class LeastRisk final : public ModeRisk<Level> {
 public:
  LeastRisk(const ActionGrouping& grouping, int workers) : actions_(grouping, true, workers) {}
  void find(const RowPlace& place, PostReader<Level>& posts, Level* next, int worker) override {
    // The operator of levels that rise looks at all cells, for any old levels.
    static_cast<void>(actions_.next_levels(place, posts, next, next, worker));
  }

 private:
  SomeAction<Level> actions_;
};

}  // namespace

ModeChoices::ModeChoices(const Controller& controller, const std::vector<std::vector<InputClass>>& partitions,
                         const std::vector<const Projections*>& rules, bool is_safest, ThreadTeam& team)
    : controller_(controller) {
  for (std::size_t p = 0; p < partitions.size(); ++p) {
    const std::vector<InputClass>& classes = partitions[p];
    Partition& partition = partitions_.emplace_back();
    partition.projections = rules[p];
    if (partition.projections != nullptr) continue;
    partition.is_safest = is_safest && classes.size() == 1;
    partition.grouping = &groupings_.emplace_back(
        *controller.engine,
        partition.is_safest ? single_classes(controller.engine->abstraction().inputs) : classes, team);
    if (!partition.is_safest)
      partition.projections = &projections_.emplace_back(controller, *partition.grouping, team);
  }
}

template <class Level>
std::vector<std::unique_ptr<ModeRisk<Level>>> ModeChoices::operators(int workers) const {
  std::vector<std::unique_ptr<ModeRisk<Level>>> result;
  for (const Partition& partition : partitions_) {
    if (partition.is_safest) {
      result.push_back(std::make_unique<LeastRisk<Level>>(*partition.grouping, workers));
    } else {
      result.push_back(
          std::make_unique<WorstRisk<Level>>(*partition.projections, *controller_.invariant, workers));
    }
  }
  return result;
}

template std::vector<std::unique_ptr<ModeRisk<std::uint32_t>>> ModeChoices::operators(int) const;
template std::vector<std::unique_ptr<ModeRisk<std::uint64_t>>> ModeChoices::operators(int) const;

}  // namespace coordreq
