#include <deque>

#include "answers/checking/all_checks.hpp"
#include "answers/checking/steps_check.hpp"

namespace coordreq {
namespace {

/// The claims about one partition, and the findings that all threads share.
struct DelayClaims {
  static constexpr const CountdownKind& kKind = kDelayKind;

  DelayClaims(const CheckContext& context, std::size_t p)
      : claims(*context.spec, *context.claims, p, kKind),
        triggers(context.claims->values("/trigger", p)),
        delay("delay " + claims.partition.name),
        trigger("trigger " + claims.partition.name),
        actions("actions " + claims.partition.name) {}

  [[nodiscard]] std::vector<Finding> findings() const {
    std::vector<Finding> result = {delay.finding(), trigger.finding()};
    if (!claims.actions.empty()) result.insert(result.begin(), actions.finding());
    return result;
  }

  PartitionClaims claims;
  const std::vector<std::int32_t>& triggers;
  Tally delay, trigger, actions;
};

class DelayChecker : public CellChecker {
 public:
  DelayChecker(const CheckContext& context, std::deque<DelayClaims>& partitions)
      : context_(context), partitions_(partitions) {
    for (const DelayClaims& one : partitions) choices_.emplace_back(context, one.claims.partition.classes);
  }

  void check(CheckedCell& cell) override {
    for (std::size_t p = 0; p < partitions_.size(); ++p) {
      DelayClaims& partition = partitions_[p];
      const PartitionClaims& claims = partition.claims;
      ClassChoices& choices = choices_[p];
      choices.go_to(cell.number(), cell.admitted());
      if (!claims.actions.empty()) check_actions(cell, partition, choices);
      const std::int32_t expected = cell.is_invariant()
                                        ? steps_by_definition(cell, choices, claims.delay, claims.most)
                                        : steps_outside(cell);
      compare_steps(context_, partition.delay, cell, claims.delay[cell.at()], expected,
                    claims.actions.empty());
      compare_trigger(context_, partition.trigger, cell, claims.delay[cell.at()], partition.triggers);
    }
  }

 private:
  /// Where posts may be others than those of the analysis, the actions of the file are taken for the choices
  /// of agents.
  void check_actions(const CheckedCell& cell, DelayClaims& partition, ClassChoices& choices) {
    compare_actions(context_, partition.actions, cell, partition.claims, choices, "actions");
    for (std::size_t c = 0; context_.sound_only() && c < choices.actions().size(); ++c)
      choices.restrict_to(c, *partition.claims.actions[c], cell.at());
  }

  const CheckContext& context_;
  std::deque<DelayClaims>& partitions_;
  std::deque<ClassChoices> choices_;  ///< [partition]
};

class LayersCheck : public StepsCheck<DelayClaims> {
 public:
  using StepsCheck::StepsCheck;
  std::unique_ptr<CellChecker> cell_checker() override {
    return std::make_unique<DelayChecker>(context_, partitions_);
  }
};

}  // namespace

/// Checks the claims about each partition, straight from the definitions:
/// - for x in K: delay(x) = 1 + min over u in IND_C(x), y in f(x, u) of delay(y), where cells outside K and
///   pairs without post, or that `allow` forbids, are worth -1. By induction on the delay this proves
///   membership in every layer, and that a cell is not in the next;
/// - triggers from delays, and stored actions from C(x);
/// - F, whether max_delay stopped the iteration, layer sizes and layer lists against the delays.
std::unique_ptr<AnswerCheck> check_layers(const CheckContext& context) {
  return std::make_unique<LayersCheck>(context);
}

}  // namespace coordreq
