#include "answers/counterexample/step_finder.hpp"

#include <algorithm>
#include <utility>

namespace coordreq {

std::optional<StepChoice> StepFinder::find(std::int64_t cell, const StepsFrom& steps, std::int64_t target,
                                           const IsWanted& is_candidate, std::int64_t number) {
  Known known;
  std::optional<StepChoice> best;
  std::int64_t followed = 0;  // number so far of equal candidates that it can follow
  posts_.move_to(cell);
  for (std::int64_t u = 0; u < posts_.inputs().count(); ++u) {
    if (!is_candidate(u)) continue;
    StepChoice choice{.joint_input = u, .post = posts_.post(u, tubes_)};
    choice.is_forbidden = inputs_.forbids(cell, u);
    choice.steps = choice.is_forbidden ? 0 : least_steps(choice.post, steps, known);
    const bool is_better =
        target == kLeast ? !best || choice.steps < best->steps : !best && choice.steps == target;
    if (is_better) followed = 0;
    if ((is_better || (best && choice.steps == best->steps)) && follows(cell, choice, steps)) {
      if (followed == number || is_better) best = std::move(choice);
      best->has_more = followed++ > number;
    } else if (is_better) {
      best = std::move(choice);
    }
    const bool is_least = best && (target != kLeast || best->steps == 0);
    if (is_least && (best->has_more || !real_.is_followed())) break;
  }
  return best;
}

/// The least steps from a post; 0 if it is blocked. @param known those of boxes looked at before
std::int64_t StepFinder::least_steps(const CellPost& post, const StepsFrom& steps, Known& known) const {
  if (post.blocked != CellPost::Blocked::no) return 0;
  if (post.all_left) return INT64_MAX;
  const auto [entry, is_new] = known.try_emplace(post.box, INT64_MAX);
  if (is_new) {
    for_each_cell(posts_.grid(), post.box, [&worst = entry->second, &steps](std::int64_t next) {
      worst = std::min(worst, steps(next));
      return worst > 0;
    });
  }
  return entry->second;
}

bool StepFinder::follows(std::int64_t cell, const StepChoice& choice, const StepsFrom& steps) {
  if (choice.is_forbidden || choice.post.blocked != CellPost::Blocked::no) return false;
  const std::int64_t next = real_cell(cell, choice.post, choice.joint_input);
  return next >= 0 && steps(next) == choice.steps;
}

bool StepFinder::holds(const UniformGrid& grid, const CellPost& post, std::int64_t cell) {
  for (std::size_t d = 0; d < grid.size(); ++d) {
    const std::int64_t k = grid.index(cell, d);
    const IndexRange& range = post.box[d];
    if ((k < range.first || k > range.last) && k + grid[d].count > range.last) return false;
  }
  return true;
}

/// The cell of the system itself after the step, if it is in the post; negative: it is not, or is no longer
/// followed.
std::int64_t StepFinder::real_cell(std::int64_t cell, const CellPost& post, std::int64_t u) {
  if (!real_.is_followed() || post.all_left) return -1;
  const NominalRun::Successor successor = real_.after(cell, u);
  const bool is_cell = successor.is_known && successor.kind == Location::Kind::cell;
  return is_cell && holds(posts_.grid(), post, successor.cell) ? successor.cell : -1;
}

std::int64_t StepFinder::next_cell(std::int64_t cell, const CellPost& post, std::int64_t u,
                                   const IsWanted& is_wanted) {
  const std::int64_t real = real_cell(cell, post, u);
  if (real >= 0 && is_wanted(real)) return real;
  std::int64_t lowest = -1;
  if (post.all_left) return lowest;
  for_each_cell(posts_.grid(), post.box, [&](std::int64_t next) {
    if (is_wanted(next) && (lowest < 0 || number_of(next) < number_of(lowest))) lowest = next;
    return true;
  });
  return lowest;
}

std::int64_t StepFinder::number_of(std::int64_t cell) const {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < problem_.number_stride.size(); ++i)
    sum += posts_.grid().index(cell, i) * problem_.number_stride[i];
  return sum;
}

}  // namespace coordreq
