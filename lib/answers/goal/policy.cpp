#include "answers/goal/answer.hpp"

#include "answers/goal/arrival.hpp"
#include "answers/one_cell/progress_inputs.hpp"
#include "answers/paths.hpp"
#include "answers/step_codes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

class GoalPolicy : public CellPolicy {
 public:
  explicit GoalPolicy(const PolicyContext& context)
      : arrival_(context.values(paths::kArrival)),
        least_(context.spec->is_goal_lasting() ? 0 : 1),
        progress_(*context.spec, *context.posts, arrival_) {}

  bool holds(std::int64_t cell) override {
    const std::int32_t arrival = arrival_(cell);
    return arrival >= least_ && arrival != kUnbounded;
  }
  const Numbers& together(std::int64_t cell, const Numbers& admissible) override {
    progressing_ = progress_.of(cell, admissible);
    return progressing_;
  }

 private:
  CellValue arrival_;
  std::int32_t least_;  ///< arrival where P holds
  ProgressInputs progress_;
  Numbers progressing_;  ///< P(x) of the last cell queried
};

}  // namespace

/// On the way to the goal (contract, section 5), in W \ G: agents who coordinate choose from P(x), silent
/// agents from IND_P(x), for as many steps as the approach delay. Of a lasting goal (section 11) in W. None
/// without a goal.
std::vector<AnswerPolicy> goal_policies(const ProblemSpec& spec) {
  if (!spec.goal) return {};
  const bool is_reached_once = spec.goal_then == GoalThen::safe;
  const std::string where_of_no_use =
      is_reached_once ? "cannot be forced, or is reached" : "cannot be forced";
  return {
      {.name = kApproachKind.name,
       .kind = &kApproachKind,
       .label = "approach",
       .gain = "loses no time",
       .delay = paths::kApproachDelay,
       .trigger = paths::kApproachTrigger,
       .aim = {.path = paths::kArrival,
               .label = spec.goal_then == GoalThen::stay ? "samples outside the goal that are still to come"
                                                         : "steps within which the goal can be forced",
               .lasts = spec.is_goal_lasting()},
       .make = make_goal_policy,
       .header = {.where = "on the way to the goal",
                  .purpose = "Towards the goal. Where it " + where_of_no_use +
                             ", the two below do not apply: continue with the two\n   above.",
                  .countdown = "Steps until the agents must start to connect, so as to lose no time, or "
                               "one of the numbers above.",
                  .allowed = "Whether class c comes nearer to the goal by its joint action a, with some "
                             "actions of the others. Where the goal\n   " +
                             std::string(spec.is_goal_lasting() ? "cannot be forced"
                                                                : "cannot be forced, or is reached") +
                             ": whether the action is allowed."}}};
}

std::unique_ptr<CellPolicy> make_goal_policy(const PolicyContext& context) {
  return std::make_unique<GoalPolicy>(context);
}

}  // namespace coordreq
