#include "answers/goal/policy.hpp"

#include "answers/goal/arrival.hpp"
#include "answers/goal/fields.hpp"
#include "answers/one_cell/progress_inputs.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

class GoalPolicy : public CellPolicy {
 public:
  explicit GoalPolicy(const PolicyContext& context)
      : arrival_(context.values(paths::kArrival)), progress_(*context.spec, *context.posts, arrival_) {}

  bool holds(std::int64_t cell) override {
    const std::int32_t arrival = arrival_(cell);
    return arrival > 0 && arrival != kNeverArrives;
  }
  const Numbers& together(std::int64_t cell, const Numbers& admissible) override {
    progressing_ = progress_.of(cell, admissible);
    return progressing_;
  }

 private:
  CellValue arrival_;
  ProgressInputs progress_;
  Numbers progressing_;  ///< P(x) of the last cell asked about
};

}  // namespace

std::vector<AnswerPolicy> goal_policies(const ProblemSpec& spec) {
  if (!spec.goal) return {};
  const std::string where_of_no_use =
      spec.ends_at_goal ? "cannot be forced" : "cannot be forced, or is reached";
  return {{.name = "approach",
           .words = "approach",
           .gain = "loses no time",
           .delay = paths::kApproachDelay,
           .trigger = paths::kApproachTrigger,
           .aim = {.path = paths::kArrival, .words = "steps within which the goal can be forced"},
           .make = make_goal_policy,
           .header = {.where = "on the way to the goal",
                      .purpose = "Towards the goal. Where it " + where_of_no_use +
                                 ", the two below do not apply: continue with the two\n   above.",
                      .countdown = "Steps until the agents must start to connect, so as to lose no time, or "
                                   "one of the numbers above.",
                      .allowed = "Whether class c comes nearer to the goal by its joint action a, with some "
                                 "actions of the others. Where the goal\n   cannot be forced, or is reached: "
                                 "whether the action is allowed."}}};
}

std::unique_ptr<CellPolicy> make_goal_policy(const PolicyContext& context) {
  return std::make_unique<GoalPolicy>(context);
}

}  // namespace coordreq
