#include "analysis/advice.hpp"
#include "answers/goal/answer.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

Warnings advise_on_goal(const Answers& answers) {
  const Goal* const goal = answers.find<Goal>();
  if (goal == nullptr || answers.ground.safe_cells == 0) return {};
  if (goal->sizes.winning == 0)
    return {
        {"goal", "/goal", "no cell of the invariance set is in the goal on this grid: it cannot be forced"}};
  if (goal->sizes.winning > goal->sizes.cells) return {};
  const bool is_closed = answers.ground.spec.abstraction.cells == Cells::closed;
  return {{"goal", "/goal",
           std::string("the goal can be forced from its own cells only") +
               (is_closed
                    ? "; with closed cells a motion of at most one cell a step still meets the cell where it "
                      "began: try smaller steps, a longer period or \"cells\": \"half_open\""
                    : "")}};
}

}  // namespace coordreq
