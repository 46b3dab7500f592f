#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "answers/checking/answer_check.hpp"
#include "answers/checking/claimed_values.hpp"
#include "answers/checking/class_choices.hpp"
#include "answers/layers/check_sizes.hpp"
#include "spec/problem_spec.hpp"

// What the checks of all countdowns share: of delays, approaches, blind countdowns and silence.
namespace coordreq {

/// The steps of a cell outside K, where there are none.
[[nodiscard]] std::int32_t steps_outside(const CheckedCell& cell);
/// 1 + min over the joint inputs that classes can choose and y in f(x, u) of steps(y), where pairs without
/// post, or that `allow` forbids, and all below `least` are worth `least`; 0 where there is no choice, and no
/// more than `most`. Unbounded where the task is over. @param choices those of the cell
[[nodiscard]] std::int32_t steps_by_definition(CheckedCell& cell, const ClassChoices& choices,
                                               const std::vector<std::int32_t>& steps,
                                               const std::optional<std::int32_t>& most,
                                               std::int32_t least = kOutsideInvariant);
/// Compares the steps of a cell in the file with those expected.
/// @param choices_differ where posts may be others than those of the analysis, choices may be, too: the file
///   does not have them
void compare_steps(const CheckContext& context, Tally& tally, const CheckedCell& cell, std::int32_t claimed,
                   std::int32_t expected, bool choices_differ = true);
/// Compares the trigger of a cell with its delay. @param triggers as claimed, of all cells
void compare_trigger(const CheckContext& context, Tally& tally, const CheckedCell& cell, std::int32_t delay,
                     const std::vector<std::int32_t>& triggers);
/// Compares the stored actions of all classes at a cell with those that they can choose.
void compare_actions(const CheckContext& context, Tally& tally, const CheckedCell& cell,
                     const PartitionClaims& claims, const ClassChoices& choices, const std::string& label);

/// The check of steps of every partition. Partition: its claims and findings, which all threads share.
template <class Partition>
class StepsCheck : public AnswerCheck {
 public:
  explicit StepsCheck(const CheckContext& context) : AnswerCheck(CheckSection::steps), context_(context) {
    for (std::size_t p = 0; p < context.spec->coordination.partitions.size(); ++p)
      partitions_.emplace_back(context, p);
  }

  std::vector<Finding> compare_sizes(Comparison& sizes) override {
    std::vector<Finding> findings;
    std::size_t longest = 1;
    for (const Partition& partition : partitions_)
      findings.push_back(compare_layers(*context_.spec, *context_.claims, partition.claims, longest));
    const std::size_t row = partitions_.empty() ? longest : partitions_.front().claims.layer_sizes.size();
    sizes.expect("length of " + Partition::kKind.prefix() + "layer", row, longest);
    return findings;
  }
  [[nodiscard]] std::vector<Finding> findings() const override {
    std::vector<Finding> result;
    for (const Partition& partition : partitions_) {
      const std::vector<Finding> findings = partition.findings();
      result.insert(result.end(), findings.begin(), findings.end());
    }
    return result;
  }

 protected:
  const CheckContext& context_;
  std::deque<Partition> partitions_;  // tallies cannot be moved
};

}  // namespace coordreq
