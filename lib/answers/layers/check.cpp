#include "answers/checking/all_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "answers/checking/answer_check.hpp"
#include "answers/checking/claimed_values.hpp"
#include "answers/layers/check_sizes.hpp"
#include "answers/step_codes.hpp"
#include "model/input_class.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

std::int32_t trigger_by_definition(std::int32_t delay, std::int64_t connection_delay) {
  if (delay < 0 || delay == kUnbounded) return delay;
  return delay < connection_delay ? kMustBeConnected : static_cast<std::int32_t>(delay - connection_delay);
}

/// Findings of one partition that all threads share.
struct PartitionTallies {
  PartitionTallies(const CheckContext& context, std::size_t p)
      : claims(*context.spec, *context.claims, p),
        delay("delay " + claims.partition.name),
        trigger("trigger " + claims.partition.name),
        actions("actions " + claims.partition.name) {
    for (const auto& agents : claims.partition.classes)
      classes.emplace_back(class_of(*context.spec, *context.inputs, agents)).tabulate();
  }

  PartitionClaims claims;
  Tally delay, trigger, actions;
  std::vector<InputClass> classes;
};

class PartitionChecker {
 public:
  PartitionChecker(const CheckContext& context, PartitionTallies& tallies)
      : context_(context), claims_(tallies.claims), tallies_(tallies), classes_(tallies.classes) {
    for (const InputClass& input_class : classes_)
      projection_.emplace_back(static_cast<std::size_t>(input_class.actions()));
  }

  void check(CheckedCell& cell) {
    project(cell.admitted());
    if (!claims_.actions.empty()) check_actions(cell);
    std::int32_t expected = cell.is_safe() ? kOutsideInvariant : kOutsideSafe;
    if (cell.is_invariant()) expected = delay_by_definition(cell);
    check_delay(cell, expected);
    check_trigger(cell);
  }

 private:
  void project(const std::vector<std::uint8_t>& admitted) {
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      std::fill(projection_[c].begin(), projection_[c].end(), 0);
      for (std::size_t u = 0; u < admitted.size(); ++u) {
        if (admitted[u] != 0)
          projection_[c][static_cast<std::size_t>(classes_[c].action(static_cast<std::int64_t>(u)))] = 1;
      }
    }
  }

  /// Where posts may be others than those of the analysis, the actions of the file are taken for the choices
  /// of agents.
  void check_actions(const CheckedCell& cell) {
    tallies_.actions.add_checked(1);
    BitDifference found;
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      const std::vector<std::uint8_t>& bytes = *claims_.actions[c];
      std::vector<std::uint8_t>& projection = projection_[c];
      const BitDifference difference = compare_bits(bytes, cell.at(), projection);
      found = {.extra = found.extra + difference.extra, .fewer = found.fewer || difference.fewer};
      const std::size_t length = (projection.size() + 7) / 8;
      for (std::size_t a = 0; context_.sound_only() && a < projection.size(); ++a) {
        if ((bytes[cell.at() * length + a / 8] >> (a % 8) & 1U) == 0) projection[a] = 0;
      }
    }
    if (found.extra > 0) {
      tallies_.actions.add_wrong(
          cell.number(), [&] { return fmt::format("{}: {} actions too many", cell.place(), found.extra); });
    } else if (found.fewer && context_.sound_only()) {
      tallies_.actions.add_unproven();
    } else if (found.fewer) {
      tallies_.actions.add_wrong(cell.number(), [&] { return cell.place() + ": actions are missing"; });
    }
  }

  [[nodiscard]] bool is_choice(std::int64_t u) const {
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      if (projection_[c][static_cast<std::size_t>(classes_[c].action(u))] == 0) return false;
    }
    return true;
  }

  [[nodiscard]] std::int32_t delay_by_definition(CheckedCell& cell) const {
    bool any = cell.is_over();
    std::int32_t worst = kUnbounded;
    const std::int64_t inputs = cell.is_over() ? 0 : context_.inputs->count();
    for (std::int64_t u = 0; u < inputs && worst > kOutsideInvariant; ++u) {
      if (!is_choice(u)) continue;
      any = true;
      const std::int32_t least =
          cell.is_forbidden(u) ? kOutsideInvariant : cell.least(u, claims_.delay, kOutsideInvariant);
      worst = std::min(worst, std::max(least, kOutsideInvariant));
    }
    const std::int32_t delay = any ? one_more(worst) : 0;
    const std::optional<std::int64_t> most = context_.spec->coordination.max_delay;
    const bool truncated = claims_.fixed_point_index < 0 && most.has_value();
    return truncated ? std::min(delay, static_cast<std::int32_t>(*most)) : delay;
  }

  void check_delay(const CheckedCell& cell, std::int32_t expected) {
    tallies_.delay.add_checked(1);
    const std::int32_t claimed = claims_.delay[cell.at()];
    if (claimed == expected) return;
    const bool other_choices = claims_.actions.empty();  // choices may differ: the file does not have them
    if (context_.sound_only() && expected >= 0 && claimed >= 0 && (claimed < expected || other_choices)) {
      tallies_.delay.add_unproven();
    } else {
      add_wrong_steps(tallies_.delay, cell, claimed, expected);
    }
  }

  void check_trigger(const CheckedCell& cell) {
    tallies_.trigger.add_checked(1);
    const std::int32_t expected =
        trigger_by_definition(claims_.delay[cell.at()], context_.spec->coordination.connection_delay);
    const std::int32_t claimed = claims_.trigger[cell.at()];
    if (claimed != expected) add_wrong_steps(tallies_.trigger, cell, claimed, expected);
  }

  const CheckContext& context_;
  const PartitionClaims& claims_;
  PartitionTallies& tallies_;
  const std::vector<InputClass>& classes_;
  std::vector<std::vector<std::uint8_t>> projection_;  ///< [class][action] of the cell being checked
};

class DelayChecker : public CellChecker {
 public:
  DelayChecker(const CheckContext& context, std::deque<PartitionTallies>& tallies) {
    for (PartitionTallies& partition : tallies) partitions_.emplace_back(context, partition);
  }
  void check(CheckedCell& cell) override {
    for (PartitionChecker& partition : partitions_) partition.check(cell);
  }

 private:
  std::vector<PartitionChecker> partitions_;
};

class LayersCheck : public AnswerCheck {
 public:
  explicit LayersCheck(const CheckContext& context) : AnswerCheck(CheckSection::steps), context_(context) {
    for (std::size_t p = 0; p < context.spec->coordination.partitions.size(); ++p)
      tallies_.emplace_back(context, p);
  }

  std::vector<Finding> compare_sizes(Comparison& sizes) override {
    std::vector<Finding> findings;
    std::size_t longest = 1;
    for (const PartitionTallies& tallies : tallies_)
      findings.push_back(compare_layers(*context_.spec, *context_.claims, tallies.claims, longest));
    const std::size_t row = tallies_.empty() ? longest : tallies_.front().claims.layer_sizes.size();
    sizes.expect("length of /layer", row, longest);
    return findings;
  }
  std::unique_ptr<CellChecker> cell_checker() override {
    return std::make_unique<DelayChecker>(context_, tallies_);
  }
  [[nodiscard]] std::vector<Finding> findings() const override {
    std::vector<Finding> result;
    for (const PartitionTallies& tallies : tallies_) {
      if (!tallies.claims.actions.empty()) result.push_back(tallies.actions.finding());
      result.push_back(tallies.delay.finding());
      result.push_back(tallies.trigger.finding());
    }
    return result;
  }

 private:
  const CheckContext& context_;
  std::deque<PartitionTallies> tallies_;  ///< [partition]; tallies cannot be moved
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
