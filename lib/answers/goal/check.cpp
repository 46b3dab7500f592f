#include "answers/checking/all_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <iterator>
#include <optional>
#include <vector>

#include "answers/checking/claimed_progress.hpp"
#include "answers/checking/steps_check.hpp"
#include "answers/goal/check_lasting.hpp"
#include "answers/invariance/check_safe.hpp"

namespace coordreq {
namespace {

/// The claims about one partition, and the findings that all threads share.
struct ApproachClaims {
  static constexpr const CountdownKind& kKind = kApproachKind;

  ApproachClaims(const CheckContext& context, std::size_t p)
      : claims(*context.spec, *context.claims, p, kKind, "/actions:goal"),
        triggers(context.claims->values("/approach_trigger", p)),
        safety(context.claims->values("/delay", p)),
        fixed_point_of_safety(context.claims->at("/fixed_point_index").integers[p]),
        delay("approach delay " + claims.partition.name),
        trigger("approach trigger " + claims.partition.name),
        actions("actions to the goal " + claims.partition.name) {}

  [[nodiscard]] std::vector<Finding> findings() const {
    std::vector<Finding> result = {delay.finding(), trigger.finding()};
    if (!claims.actions.empty()) result.push_back(actions.finding());
    return result;
  }

  PartitionClaims claims;
  const std::vector<std::int32_t>& triggers;
  const std::vector<std::int32_t>& safety;  ///< delays
  std::int64_t fixed_point_of_safety;
  Tally delay, trigger, actions;
};

/// The tallies of no partition, which all threads share.
struct GoalTallies {
  /// @param is_lasting arrival has more than one solution then
  explicit GoalTallies(bool is_lasting) : arrival(is_lasting ? "arrival (fixed point)" : "arrival") {}

  Tally goal{"goal"};
  Tally arrival;
  Tally controller{"controller to the goal"};
};

class GoalChecker : public CellChecker {
 public:
  /// @param lasting null: the goal is none
  GoalChecker(const CheckContext& context, GoalTallies& tallies, std::deque<ApproachClaims>& partitions,
              SafeMemory& memory, LastingCheck* lasting)
      : context_(context),
        lasting_(lasting),
        arrival_(context.claims->values("/arrival")),
        tallies_(tallies),
        partitions_(partitions),
        by_definition_(context),
        controller_(context.claims->bits("/controller:goal")),
        judge_(*context.spec, *context.spec->goal, *context.grid, memory) {
    for (const ApproachClaims& one : partitions) choices_.emplace_back(context, one.claims.partition.classes);
  }

  void check(CheckedCell& cell) override {
    const std::int32_t arrival = arrival_[cell.at()];
    // All cells of a goal that ends the task are in K, so that all cells of S are checked.
    if (lasting_ == nullptr && (context_.spec->ends_at_goal() ? cell.is_safe() : cell.is_invariant()))
      check_goal(cell, arrival == 0);
    check_arrival(cell, arrival);
    find_progress(cell, arrival);
    if (controller_ != nullptr)
      add_choices(context_, tallies_.controller, cell, compare_bits(*controller_, cell.at(), progress_), "");
    for (std::size_t p = 0; p < partitions_.size(); ++p) {
      ApproachClaims& partition = partitions_[p];
      choices_[p].go_to(cell.number(), progress_);
      compare_steps(context_, partition.delay, cell, partition.claims.delay[cell.at()],
                    approach_by_definition(cell, partition, choices_[p]));
      compare_trigger(context_, partition.trigger, cell, partition.claims.delay[cell.at()],
                      partition.triggers);
      if (!partition.claims.actions.empty())
        compare_actions(context_, partition.actions, cell, partition.claims, choices_[p], "");
    }
  }

 private:
  /// Finds P(x); C(x) in a goal that does not last, and nothing in a cell from which the goal cannot be
  /// forced.
  void find_progress(CheckedCell& cell, std::int32_t arrival) {
    progress_.assign(cell.admitted().size(), 0);
    if (!cell.is_invariant()) return;
    if (arrival == 0) progress_ = cell.admitted();
    if (by_definition_.is_before_goal(cell.at())) progress_ = by_definition_.of(cell);
  }

  /// Checks arrivals, approach delays and their triggers by their local equations: the equation of arrival
  /// has exactly one solution, so that arrivals which obey it everywhere are right; and the cells of the
  /// goal, by an evaluation of its own. Null without a goal.
  void check_goal(const CheckedCell& cell, bool is_claimed) {
    tallies_.goal.add_checked(1);
    const SafeVerdict verdict = judge_.judge(cell.number(), is_claimed);
    if (!is_claimed && verdict == SafeVerdict::safe) {
      add_wrong(tallies_.goal, cell, "does not count as the goal, but it is");
    } else if (is_claimed && verdict == SafeVerdict::unsafe) {
      add_wrong(tallies_.goal, cell, "counts as the goal, but it is not");
    } else if (is_claimed && verdict == SafeVerdict::open) {
      tallies_.goal.add_unproven();
    }
  }

  void check_arrival(CheckedCell& cell, std::int32_t claimed) {
    tallies_.arrival.add_checked(1);
    std::int32_t expected = steps_outside(cell);
    if (cell.is_invariant() && lasting_ != nullptr) {
      expected = lasting_arrival(cell, claimed);
    } else if (cell.is_invariant()) {
      expected = claimed == 0 ? 0 : one_more(by_definition_.best(cell));
    }
    if (claimed == expected) return;
    if (context_.sound_only() && expected >= 0 && claimed > expected) {
      tallies_.arrival.add_unproven();
    } else {
      add_wrong_steps(tallies_.arrival, cell, claimed, expected);
    }
  }

  [[nodiscard]] std::int32_t lasting_arrival(CheckedCell& cell, std::int32_t claimed) {
    const std::int32_t best = by_definition_.best(cell);
    const SafeVerdict verdict = judge_.judge(cell.number(), true);
    const LastingCheck::Judged judged = lasting_->judge(cell, claimed, verdict, best);
    tallies_.goal.add_checked(1);
    if (judged.is_unproven) tallies_.goal.add_unproven();
    if (context_.spec->goal_then == GoalThen::come_back && claimed == 0 && best != kUnbounded) {
      std::int32_t worst = best;
      for (std::size_t u = 0; u < cell.admitted().size(); ++u) {
        const std::int32_t value =
            cell.admitted()[u] == 0 ? kUnbounded : by_definition_.worst(cell, static_cast<std::int64_t>(u));
        if (value != kUnbounded) worst = std::max(worst, value);
      }
      lasting_->add_step(best, worst);
    }
    return judged.expected;
  }

  [[nodiscard]] std::int32_t approach_by_definition(CheckedCell& cell, const ApproachClaims& partition,
                                                    const ClassChoices& choices) {
    if (!cell.is_invariant()) return steps_outside(cell);
    const std::int32_t arrival = arrival_[cell.at()];
    const std::optional<std::int32_t>& most = partition.claims.most;
    const auto at_most = [&most](std::int32_t steps) { return most ? std::min(steps, *most) : steps; };
    if (arrival == kUnbounded) return kOutsideWinning;
    if (arrival == 0 && lasting_ == nullptr)
      return at_most(cell.is_terminal() ? kUnbounded : partition.safety[cell.at()]);
    const std::int32_t limit = by_definition_.limit(cell);
    for (std::int64_t u = 0; u < choices.joint_inputs(); ++u) {
      if (choices.has(u) && (cell.is_forbidden(u) || by_definition_.worst(cell, u) > limit)) return 0;
    }
    return steps_by_definition(cell, choices, partition.claims.delay, most, 0);
  }

  const CheckContext& context_;
  LastingCheck* lasting_;
  const std::vector<std::int32_t>& arrival_;
  GoalTallies& tallies_;
  std::deque<ApproachClaims>& partitions_;
  ClaimedProgress by_definition_;
  const std::vector<std::uint8_t>* controller_;  ///< null: not stored
  SafeJudge judge_;
  std::vector<std::uint8_t> progress_;  ///< of the cell being checked, see find_progress()
  std::deque<ClassChoices> choices_;    ///< [partition] of it
};

class GoalCheck : public StepsCheck<ApproachClaims> {
 public:
  explicit GoalCheck(const CheckContext& context)
      : StepsCheck(context),
        memory_(*context.spec->goal, *context.grid),
        tallies_(context.spec->is_goal_lasting()) {
    if (context.spec->is_goal_lasting()) lasting_.emplace(context);
  }

  std::vector<Finding> compare_sizes(Comparison& sizes) override {
    std::int64_t goal = 0, winning = 0, longest = -1;
    for (const std::int32_t arrival : context_.claims->values("/arrival")) {
      goal += arrival == 0 ? 1 : 0;
      if (arrival < 0 || arrival == kUnbounded) continue;
      ++winning;
      longest = std::max(longest, std::int64_t{arrival});
    }
    const Claims& claims = *context_.claims;
    if (!lasting_) sizes.expect("|G|", claims.attribute("/arrival", "goal_cells"), goal);
    sizes.expect("|W|", claims.attribute("/arrival", "winning_cells"), winning);
    sizes.expect("longest arrival", claims.attribute("/arrival", "longest_arrival"), longest);
    std::vector<Finding> findings;
    std::size_t layers = 1;
    for (const ApproachClaims& one : partitions_) findings.push_back(compare_layers(one, layers));
    sizes.expect("length of /approach_layer", claims.at("/approach_layer_size").integers.size(),
                 layers * partitions_.size());
    return findings;
  }
  std::unique_ptr<CellChecker> cell_checker() override {
    return std::make_unique<GoalChecker>(context_, tallies_, partitions_, memory_,
                                         lasting_ ? &*lasting_ : nullptr);
  }
  void check_all(ThreadTeam& team) override {
    if (lasting_) lasting_->check_all(team);
  }
  [[nodiscard]] std::vector<Finding> findings() const override {
    std::vector<Finding> result = {tallies_.goal.finding(), tallies_.arrival.finding()};
    if (lasting_) std::ranges::move(lasting_->findings(), std::back_inserter(result));
    if (context_.spec->output.controller) result.push_back(tallies_.controller.finding());
    std::ranges::move(StepsCheck::findings(), std::back_inserter(result));
    return result;
  }

 private:
  /// Compares |A_k| of one partition, and F, with the delays of its cells.
  /// @param layers the most layers of any partition so far
  [[nodiscard]] Finding compare_layers(const ApproachClaims& partition, std::size_t& layers) const {
    const PartitionClaims& claims = partition.claims;
    Comparison comparison(claims.kind.label + (" " + claims.partition.name));
    const std::size_t length = claims.layer_sizes.size();
    std::vector<std::int64_t> sizes(length, 0);
    std::int64_t last = -1;  // the greatest delay that is not unbounded
    bool unbounded = false;
    for (const std::int32_t delay : claims.delay) {
      if (delay < 0) continue;
      unbounded = unbounded || delay == kUnbounded;
      if (delay != kUnbounded) last = std::max(last, std::int64_t{delay});
      for (std::size_t k = 0; k < length && (delay == kUnbounded || static_cast<std::int64_t>(k) <= delay);
           ++k)
        ++sizes[k];
    }
    for (std::size_t k = 0; k < length; ++k)
      comparison.expect(fmt::format("|A_{}|", k), claims.layer_sizes[k], sizes[k]);
    const std::int64_t index = claims.fixed_point_index;
    comparison.expect("F", index, is_stopped(partition, last, unbounded) ? -1 : last + 1);
    layers = std::max(layers, static_cast<std::size_t>(index < 0 ? last : last + 1) + 1);
    return comparison.finding();
  }

  /// Whether `max_delay` M stopped the iteration: unless A_M is empty, or A and Z (A alone, of a goal that
  /// lasts) stood still before. If the file says so, cells of delay M are those of the last layer.
  [[nodiscard]] bool is_stopped(const ApproachClaims& partition, std::int64_t last, bool unbounded) const {
    const std::optional<std::int64_t> most = context_.spec->coordination.max_delay;
    if (!most) return false;
    const bool claimed = partition.claims.fixed_point_index < 0;
    if (claimed && (unbounded || last != *most)) return false;
    if (!claimed && !unbounded) return last >= *most;  // the layers were empty before
    std::int64_t fixed = 0;                            // A_k is constant from here on
    for (const std::int32_t delay : partition.claims.delay) {
      if (delay >= 0 && delay != kUnbounded && delay < *most)
        fixed = std::max(fixed, std::int64_t{delay} + 1);
    }
    if (lasting_) return fixed >= *most;
    const std::int64_t of_safety = partition.fixed_point_of_safety;
    return of_safety < 0 || std::max(fixed, of_safety) >= *most;
  }

  SafeMemory memory_;
  GoalTallies tallies_;
  std::optional<LastingCheck> lasting_;
};

}  // namespace

std::unique_ptr<AnswerCheck> check_goal(const CheckContext& context) {
  return context.spec->goal ? std::make_unique<GoalCheck>(context) : nullptr;
}

}  // namespace coordreq
