#include "answers/checking/all_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <string>
#include <vector>

#include "answers/checking/answer_check.hpp"
#include "answers/checking/claimed_progress.hpp"
#include "answers/checking/claimed_values.hpp"
#include "answers/goal/check_lasting.hpp"
#include "answers/invariance/check_safe.hpp"
#include "answers/step_codes.hpp"
#include "model/input_class.hpp"
#include "spec/partition_names.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Findings of one partition that all threads share.
struct ApproachTallies {
  explicit ApproachTallies(const std::string& name)
      : delay("approach delay " + name),
        trigger("approach trigger " + name),
        actions("actions to the goal " + name) {}

  Tally delay, trigger, actions;
};

/// The tallies that all threads share.
struct GoalTallies {
  /// @param is_lasting arrival has more than one solution then
  explicit GoalTallies(bool is_lasting) : arrival(is_lasting ? "arrival (fixed point)" : "arrival") {}

  Tally goal{"goal"};
  Tally arrival;
  Tally controller{"controller to the goal"};
  std::deque<ApproachTallies> approach;  // tallies cannot be moved
};

/// The claims of the file about the goal.
struct GoalClaims {
  explicit GoalClaims(const Claims& claims)
      : arrival(claims.values("/arrival")),
        delay(claims.at("/approach_delay").values),
        trigger(claims.at("/approach_trigger").values),
        safety(claims.at("/delay").values),
        sizes(claims.at("/approach_layer_size").integers),
        fixed_points(claims.at("/approach_fixed_point_index").integers),
        of_safety(claims.at("/fixed_point_index").integers) {}

  const std::vector<std::int32_t>& arrival;
  const std::vector<std::vector<std::int32_t>>& delay;    ///< [partition][cell]
  const std::vector<std::vector<std::int32_t>>& trigger;  ///< likewise
  const std::vector<std::vector<std::int32_t>>& safety;   ///< delays, likewise
  const std::vector<std::int64_t>& sizes;                 ///< [partition, layer]
  const std::vector<std::int64_t>& fixed_points;          ///< [partition]
  const std::vector<std::int64_t>& of_safety;             ///< likewise, of the delays
};

/// A class of a partition, and its actions in the file.
struct GoalClass {
  InputClass own;
  const std::vector<std::uint8_t>* actions = nullptr;  ///< null: not stored
};

class GoalChecker : public CellChecker {
 public:
  /// @param lasting null: the goal is none
  GoalChecker(const CheckContext& context, const GoalClaims& claims, GoalTallies& tallies, SafeMemory& memory,
              LastingCheck* lasting)
      : context_(context),
        lasting_(lasting),
        claims_(claims),
        tallies_(tallies),
        by_definition_(context),
        controller_(context.claims->bits("/controller:goal")),
        judge_(*context.spec, *context.spec->goal, *context.grid, memory) {
    const ProblemSpec& spec = *context.spec;
    for (const PartitionSpec& partition : spec.coordination.partitions) {
      std::vector<GoalClass>& all = classes_.emplace_back();
      for (const auto& agents : partition.classes) {
        const std::string name = class_name(spec.agents, agents);
        GoalClass& one = all.emplace_back(GoalClass{class_of(spec, *context.inputs, agents)});
        one.own.tabulate();
        one.actions = context.claims->bits("/actions:goal/" + partition.name + "/" + name);
      }
    }
  }

  void check(CheckedCell& cell) override {
    const std::int32_t arrival = claims_.arrival[cell.at()];
    // All cells of a goal that ends the task are in K, so that all cells of S are checked.
    if (lasting_ == nullptr && (context_.spec->ends_at_goal() ? cell.is_safe() : cell.is_invariant()))
      check_goal(cell, arrival == 0);
    check_arrival(cell, arrival);
    find_progress(cell, arrival);
    if (controller_ != nullptr)
      compare(tallies_.controller, cell, compare_bits(*controller_, cell.at(), progress_));
    for (std::size_t p = 0; p < classes_.size(); ++p) {
      project(p);
      check_approach(cell, p);
      check_trigger(cell, p);
      check_actions(cell, p);
    }
  }

 private:
  /// Finds P(x); C(x) in a goal that does not last, and nothing in a cell from which the goal cannot be
  /// forced.
  void find_progress(CheckedCell& cell, std::int32_t arrival) {
    progress_.assign(cell.admitted().size(), 0);
    if (!cell.is_invariant()) return;
    if (arrival == 0) progress_ = cell.admitted();
    if (by_definition_.is_on_the_way(cell.at())) progress_ = by_definition_.of(cell);
  }

  /// The actions of each class of a partition that some joint input of P(x) has.
  void project(std::size_t p) {
    projections_.clear();
    for (const GoalClass& one : classes_[p]) {
      std::vector<std::uint8_t>& projection =
          projections_.emplace_back(static_cast<std::size_t>(one.own.actions()), std::uint8_t{0});
      for (std::size_t u = 0; u < progress_.size(); ++u) {
        if (progress_[u] != 0)
          projection[static_cast<std::size_t>(one.own.action(static_cast<std::int64_t>(u)))] = 1;
      }
    }
  }

  void check_actions(const CheckedCell& cell, std::size_t p) {
    BitDifference found;
    bool any = false;
    for (std::size_t c = 0; c < classes_[p].size(); ++c) {
      if (classes_[p][c].actions == nullptr) continue;
      any = true;
      const BitDifference difference = compare_bits(*classes_[p][c].actions, cell.at(), projections_[c]);
      found = {.extra = found.extra + difference.extra, .fewer = found.fewer || difference.fewer};
    }
    if (any) compare(tallies_.approach[p].actions, cell, found);
  }

  void compare(Tally& tally, const CheckedCell& cell, const BitDifference& found) const {
    tally.add_checked(1);
    if (found.extra > 0) {
      tally.add_wrong(cell.number(),
                      [&] { return fmt::format("{}: {} too many", cell.place(), found.extra); });
    } else if (found.fewer && context_.sound_only()) {
      tally.add_unproven();
    } else if (found.fewer) {
      wrong(tally, cell, "some are missing");
    }
  }

  /// Checks arrivals, approach delays and their triggers by their local equations: the equation of arrival
  /// has exactly one solution, so that arrivals which obey it everywhere are right; and the cells of the
  /// goal, by an evaluation of its own. Null without a goal.
  void check_goal(const CheckedCell& cell, bool is_claimed) {
    tallies_.goal.add_checked(1);
    const SafeVerdict verdict = judge_.judge(cell.number(), is_claimed);
    if (!is_claimed && verdict == SafeVerdict::safe) {
      wrong(tallies_.goal, cell, "does not count as the goal, but it is");
    } else if (is_claimed && verdict == SafeVerdict::unsafe) {
      wrong(tallies_.goal, cell, "counts as the goal, but it is not");
    } else if (is_claimed && verdict == SafeVerdict::open) {
      tallies_.goal.add_unproven();
    }
  }

  void check_arrival(CheckedCell& cell, std::int32_t claimed) {
    tallies_.arrival.add_checked(1);
    std::int32_t expected = cell.is_safe() ? kOutsideInvariant : kOutsideSafe;
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
        const std::int32_t own =
            cell.admitted()[u] == 0 ? kUnbounded : by_definition_.worst(cell, static_cast<std::int64_t>(u));
        if (own != kUnbounded) worst = std::max(worst, own);
      }
      lasting_->add_step(best, worst);
    }
    return judged.expected;
  }

  void check_approach(CheckedCell& cell, std::size_t p) {
    Tally& tally = tallies_.approach[p].delay;
    tally.add_checked(1);
    const std::int32_t claimed = claims_.delay[p][cell.at()];
    const std::int32_t arrival = claims_.arrival[cell.at()];
    std::int32_t expected = cell.is_safe() ? kOutsideInvariant : kOutsideSafe;
    if (cell.is_invariant()) {
      expected = arrival == kUnbounded                 ? kOutsideWinning
                 : cell.is_over()                      ? kUnbounded
                 : arrival == 0 && lasting_ == nullptr ? claims_.safety[p][cell.at()]
                                                       : approach_by_definition(cell, p);
      const std::optional<std::int64_t> most = context_.spec->coordination.max_delay;
      if (most && claims_.fixed_points[p] < 0)
        expected = std::min(expected, static_cast<std::int32_t>(*most));
    }
    if (claimed == expected) return;
    // The file does not have the choices of agents.
    if (context_.sound_only() && expected >= 0 && claimed >= 0) {
      tally.add_unproven();
    } else {
      add_wrong_steps(tally, cell, claimed, expected);
    }
  }

  [[nodiscard]] std::int32_t approach_by_definition(CheckedCell& cell, std::size_t p) {
    std::vector<std::int64_t> choices;
    const std::int32_t most = by_definition_.limit(cell);
    for (std::int64_t u = 0; u < context_.inputs->count(); ++u) {
      bool is_choice = true;
      for (std::size_t c = 0; is_choice && c < projections_.size(); ++c)
        is_choice = projections_[c][static_cast<std::size_t>(classes_[p][c].own.action(u))] != 0;
      if (!is_choice) continue;
      if (cell.is_forbidden(u) || by_definition_.worst(cell, u) > most) return 0;
      choices.push_back(u);
    }
    std::int32_t worst = kUnbounded;
    for (const std::int64_t u : choices) worst = std::min(worst, cell.least(u, claims_.delay[p], 0));
    return one_more(std::max(worst, 0));
  }

  void check_trigger(const CheckedCell& cell, std::size_t p) {
    Tally& tally = tallies_.approach[p].trigger;
    tally.add_checked(1);
    const std::int32_t delay = claims_.delay[p][cell.at()];
    const std::int64_t needed = context_.spec->coordination.connection_delay;
    const std::int32_t expected = delay < 0 || delay == kUnbounded ? delay
                                  : delay < needed                 ? kMustBeConnected
                                                   : static_cast<std::int32_t>(delay - needed);
    const std::int32_t claimed = claims_.trigger[p][cell.at()];
    if (claimed != expected) add_wrong_steps(tally, cell, claimed, expected);
  }

  static void wrong(Tally& tally, const CheckedCell& cell, const char* what) {
    tally.add_wrong(cell.number(), [&] { return fmt::format("{}: {}", cell.place(), what); });
  }

  const CheckContext& context_;
  LastingCheck* lasting_;
  const GoalClaims& claims_;
  GoalTallies& tallies_;
  ClaimedProgress by_definition_;
  const std::vector<std::uint8_t>* controller_;  ///< null: not stored
  SafeJudge judge_;
  std::vector<std::vector<GoalClass>> classes_;  ///< [partition]
  // The cell being checked:
  std::vector<std::uint8_t> progress_;                  ///< see find_progress()
  std::vector<std::vector<std::uint8_t>> projections_;  ///< [class of the partition being checked][action]
};

class GoalCheck : public AnswerCheck {
 public:
  explicit GoalCheck(const CheckContext& context)
      : AnswerCheck(CheckSection::steps),
        context_(context),
        claims_(*context.claims),
        memory_(*context.spec->goal, *context.grid),
        tallies_(context.spec->is_goal_lasting()) {
    for (const PartitionSpec& partition : context.spec->coordination.partitions)
      tallies_.approach.emplace_back(partition.name);
    if (context.spec->is_goal_lasting()) lasting_.emplace(context);
  }

  std::vector<Finding> compare_sizes(Comparison& sizes) override {
    std::int64_t goal = 0, winning = 0, longest = -1;
    for (const std::int32_t arrival : claims_.arrival) {
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
    for (std::size_t p = 0; p < claims_.delay.size(); ++p) findings.push_back(compare_layers(p, layers));
    sizes.expect("length of /approach_layer", claims_.sizes.size(), layers * claims_.delay.size());
    return findings;
  }
  std::unique_ptr<CellChecker> cell_checker() override {
    return std::make_unique<GoalChecker>(context_, claims_, tallies_, memory_,
                                         lasting_ ? &*lasting_ : nullptr);
  }
  void check_all(ThreadTeam& team) override {
    if (lasting_) lasting_->check_all(team);
  }
  [[nodiscard]] std::vector<Finding> findings() const override {
    std::vector<Finding> result = {tallies_.goal.finding(), tallies_.arrival.finding()};
    if (lasting_) std::ranges::move(lasting_->findings(), std::back_inserter(result));
    if (context_.spec->output.controller) result.push_back(tallies_.controller.finding());
    for (const ApproachTallies& tallies : tallies_.approach) {
      result.push_back(tallies.delay.finding());
      result.push_back(tallies.trigger.finding());
      if (context_.spec->output.actions) result.push_back(tallies.actions.finding());
    }
    return result;
  }

 private:
  /// Compares |A_k| of one partition, and F, with the delays of its cells.
  /// @param layers the most layers of any partition so far
  [[nodiscard]] Finding compare_layers(std::size_t p, std::size_t& layers) const {
    Comparison comparison("approach layers " + context_.spec->coordination.partitions[p].name);
    const std::size_t length = claims_.sizes.size() / claims_.delay.size();
    std::vector<std::int64_t> sizes(length, 0);
    std::int64_t last = -1;  // the greatest delay that is not unbounded
    bool unbounded = false;
    for (const std::int32_t delay : claims_.delay[p]) {
      if (delay < 0) continue;
      unbounded = unbounded || delay == kUnbounded;
      if (delay != kUnbounded) last = std::max(last, std::int64_t{delay});
      for (std::size_t k = 0; k < length && (delay == kUnbounded || static_cast<std::int64_t>(k) <= delay);
           ++k)
        ++sizes[k];
    }
    for (std::size_t k = 0; k < length; ++k)
      comparison.expect(fmt::format("|A_{}|", k), claims_.sizes[p * length + k], sizes[k]);
    const std::int64_t index = claims_.fixed_points[p];
    comparison.expect("F", index, is_stopped(p, last, unbounded, index < 0) ? -1 : last + 1);
    layers = std::max(layers, static_cast<std::size_t>(index < 0 ? last : last + 1) + 1);
    return comparison.finding();
  }

  /// Whether `max_delay` M stopped the iteration: unless A_M is empty, or A and Z (A alone, of a goal that
  /// lasts) stood still before.
  /// @param claimed whether the file says so; then cells of delay M are those of the last layer
  [[nodiscard]] bool is_stopped(std::size_t p, std::int64_t last, bool unbounded, bool claimed) const {
    const std::optional<std::int64_t> most = context_.spec->coordination.max_delay;
    if (!most) return false;
    if (claimed && (unbounded || last != *most)) return false;
    if (!claimed && !unbounded) return last >= *most;  // the layers were empty before
    std::int64_t fixed = 0;                            // A_k is constant from here on
    for (const std::int32_t delay : claims_.delay[p]) {
      if (delay >= 0 && delay != kUnbounded && delay < *most)
        fixed = std::max(fixed, std::int64_t{delay} + 1);
    }
    if (lasting_) return fixed >= *most;
    const std::int64_t of_safety = claims_.of_safety[p];
    return of_safety < 0 || std::max(fixed, of_safety) >= *most;
  }

  const CheckContext& context_;
  GoalClaims claims_;
  SafeMemory memory_;
  GoalTallies tallies_;
  std::optional<LastingCheck> lasting_;
};

}  // namespace

std::unique_ptr<AnswerCheck> check_goal(const CheckContext& context) {
  return context.spec->goal ? std::make_unique<GoalCheck>(context) : nullptr;
}

}  // namespace coordreq
