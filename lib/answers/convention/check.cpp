#include "answers/checking/all_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "answers/checking/answer_check.hpp"
#include "answers/checking/claimed_progress.hpp"
#include "model/input_class.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Findings that all threads share.
struct ConventionTallies {
  Tally freedom{"convention"};
  Tally actions{"convention actions"};
};

class ConventionChecker : public CellChecker {
 public:
  ConventionChecker(const CheckContext& context, ConventionTallies& tallies);

  void check(CheckedCell& cell) override {
    const bool is_before_goal = progress_ && progress_->is_before_goal(cell.at());
    admitted_ = is_before_goal ? progress_->of(cell) : cell.admitted();
    if (cell.is_terminal()) std::ranges::fill(admitted_, std::uint8_t{0});  // no agent chooses anything
    find(admitted_);
    check_freedom(cell);
    if (actions_.front() != nullptr) check_actions(cell);
  }

 private:
  using Sets = std::vector<std::vector<std::uint8_t>>;  ///< [agent][action]

  void find(const std::vector<std::uint8_t>& admitted);
  [[nodiscard]] bool can_add(std::size_t agent, std::size_t action,
                             const std::vector<std::uint8_t>& admitted) const;
  [[nodiscard]] bool is_product_in(const Sets& sets, const std::vector<std::uint8_t>& admitted) const;
  [[nodiscard]] Sets claimed_sets(std::size_t cell) const;
  void check_actions(const CheckedCell& cell);
  void check_freedom(const CheckedCell& cell);

  const CheckContext& context_;
  const std::vector<std::vector<float>>& freedom_;         ///< [agent][cell]
  std::vector<const std::vector<std::uint8_t>*> actions_;  ///< [agent]; null: not stored
  ConventionTallies& tallies_;
  std::vector<InputClass> agents_;
  /// [agent][action] The joint inputs with that action.
  std::vector<std::vector<std::vector<std::int32_t>>> joint_;
  std::optional<ClaimedProgress> progress_;  ///< with a goal
  std::vector<std::uint8_t> admitted_;  ///< [joint input] of the cell at work: in C(x), or P(x) on the way
  Sets sets_;                           ///< of the cell at work
};

ConventionChecker::ConventionChecker(const CheckContext& context, ConventionTallies& tallies)
    : context_(context), freedom_(context.claims->at("/convention_freedom").reals), tallies_(tallies) {
  if (context.spec->goal) progress_.emplace(context);
  for (std::size_t a = 0; a < context.spec->agents.size(); ++a) {
    actions_.push_back(context.claims->bits("/actions:convention/" + context.spec->agents[a].name));
    InputClass& input_class =
        agents_.emplace_back(class_of(*context.spec, *context.inputs, {static_cast<std::int32_t>(a)}));
    input_class.tabulate();
    auto& joint = joint_.emplace_back(static_cast<std::size_t>(input_class.actions()));
    for (std::int64_t u = 0; u < context.inputs->count(); ++u)
      joint[static_cast<std::size_t>(input_class.action(u))].push_back(static_cast<std::int32_t>(u));
  }
}

/// Whether the product stays in C(x) with one more action of one agent.
bool ConventionChecker::can_add(std::size_t agent, std::size_t action,
                                const std::vector<std::uint8_t>& admitted) const {
  const std::vector<std::int32_t>& joint = joint_[agent][action];
  return std::all_of(joint.begin(), joint.end(), [&](std::int32_t u) {
    if (admitted[static_cast<std::size_t>(u)] != 0) return true;
    for (std::size_t j = 0; j < agents_.size(); ++j) {
      const auto other = static_cast<std::size_t>(agents_[j].action(u));
      if (j != agent && sets_[j][other] == 0) return true;  // not in the product
    }
    return false;
  });
}

void ConventionChecker::find(const std::vector<std::uint8_t>& admitted) {
  sets_.clear();
  for (const InputClass& agent : agents_) sets_.emplace_back(static_cast<std::size_t>(agent.actions()), 0);
  const auto lowest = std::find(admitted.begin(), admitted.end(), 1);
  if (lowest == admitted.end()) return;
  const auto seed = static_cast<std::size_t>(lowest - admitted.begin());
  for (std::size_t i = 0; i < agents_.size(); ++i)
    sets_[i][static_cast<std::size_t>(agents_[i].action(static_cast<std::int64_t>(seed)))] = 1;
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    for (std::size_t a = 0; a < sets_[i].size(); ++a) {
      if (sets_[i][a] == 0 && can_add(i, a, admitted)) sets_[i][a] = 1;
    }
  }
}

bool ConventionChecker::is_product_in(const Sets& sets, const std::vector<std::uint8_t>& admitted) const {
  for (const std::vector<std::uint8_t>& set : sets) {
    if (std::find(set.begin(), set.end(), 1) == set.end()) return false;
  }
  for (std::size_t u = 0; u < admitted.size(); ++u) {
    bool chosen = admitted[u] == 0;
    for (std::size_t i = 0; chosen && i < agents_.size(); ++i)
      chosen = sets[i][static_cast<std::size_t>(agents_[i].action(static_cast<std::int64_t>(u)))] != 0;
    if (chosen) return false;
  }
  return true;
}

ConventionChecker::Sets ConventionChecker::claimed_sets(std::size_t cell) const {
  Sets sets;
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    const auto bytes = static_cast<std::size_t>(agents_[i].bytes());
    const std::uint8_t* const row = actions_[i]->data() + cell * bytes;
    // Bits beyond the last action must be 0: one that is set makes the sets differ.
    std::vector<std::uint8_t>& set = sets.emplace_back(bytes * 8);
    for (std::size_t a = 0; a < set.size(); ++a) set[a] = row[a / 8] >> (a % 8) & 1U;
    const auto count = static_cast<std::size_t>(agents_[i].actions());
    if (std::find(set.begin() + static_cast<std::ptrdiff_t>(count), set.end(), 1) == set.end())
      set.resize(count);
  }
  return sets;
}

void ConventionChecker::check_actions(const CheckedCell& cell) {
  tallies_.actions.add_checked(1);
  const Sets claimed = claimed_sets(cell.at());
  if (claimed == sets_) return;
  if (context_.sound_only() && is_product_in(claimed, admitted_)) {
    tallies_.actions.add_unproven();
    return;
  }
  tallies_.actions.add_wrong(cell.number(),
                             [&] { return cell.location() + ": not the actions of the convention"; });
}

void ConventionChecker::check_freedom(const CheckedCell& cell) {
  tallies_.freedom.add_checked(1);
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    const auto kept = std::count(sets_[i].begin(), sets_[i].end(), 1);
    std::int64_t all = 0;
    for (const std::vector<std::int32_t>& joint : joint_[i]) {
      all += std::any_of(joint.begin(), joint.end(),
                         [&](std::int32_t u) { return admitted_[static_cast<std::size_t>(u)] != 0; })
                 ? 1
                 : 0;
    }
    const float claimed = freedom_[i][cell.at()];
    if (all == 0 && std::isnan(claimed)) continue;
    const auto expected = static_cast<float>(static_cast<double>(kept) / static_cast<double>(all));
    if (all > 0 && claimed == expected) continue;
    if (context_.sound_only() && all > 0 && claimed > 0 && claimed <= 1) {
      tallies_.freedom.add_unproven();
    } else {
      tallies_.freedom.add_wrong(cell.number(), [&] {
        return fmt::format("{}: {} keeps {}, expected {} of {} actions", cell.location(),
                           context_.spec->agents[i].name, claimed, kept, all);
      });
    }
    return;
  }
}

class ConventionCheck : public AnswerCheck {
 public:
  explicit ConventionCheck(const CheckContext& context)
      : AnswerCheck(CheckSection::choices), context_(context) {}

  std::unique_ptr<CellChecker> cell_checker() override {
    return std::make_unique<ConventionChecker>(context_, tallies_);
  }
  [[nodiscard]] std::vector<Finding> findings() const override {
    std::vector<Finding> result = {tallies_.freedom.finding()};
    if (context_.spec->output.actions) result.push_back(tallies_.actions.finding());
    return result;
  }

 private:
  const CheckContext& context_;
  ConventionTallies tallies_;
};

}  // namespace

/// Checks the convention of one cell after the other, from C(x) by its definition: from the lowest-numbered
/// joint input on, agents in order add their actions, ascending, as long as the product stays in C(x). Where
/// C(x) is perhaps larger than that of the analysis, another convention is wrong only where it leaves C(x).
/// @returns null: the spec asks for none
std::unique_ptr<AnswerCheck> check_convention(const CheckContext& context) {
  if (!context.spec->coordination.convention) return nullptr;
  return std::make_unique<ConventionCheck>(context);
}

}  // namespace coordreq
