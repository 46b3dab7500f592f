#include "answers/one_cell/progress_inputs.hpp"

#include <algorithm>

#include "answers/one_cell/cell_members.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

bool ProgressInputs::leaves_through_safe_side(std::int64_t u) const {
  for (std::size_t i = 0; i < posts_.grid().size(); ++i) {
    const GridDimension& dimension = posts_.grid()[i];
    const IndexRange raw = posts_.raw(i, u);
    if (raw.first < 0 && traits(dimension.below).is_only_safe()) return true;
    if (raw.last >= dimension.count && traits(dimension.above).is_only_safe()) return true;
  }
  return false;
}

std::int32_t ProgressInputs::worst_in(const std::vector<IndexRange>& box) {
  const auto [entry, is_new] = known_.try_emplace(box, 0);
  if (is_new) {
    for_each_cell(posts_.grid(), box, [&worst = entry->second, this](std::int64_t y) {
      const std::int32_t value = arrival_(y);
      worst = std::max(worst, value < 0 ? INT32_MAX : value);
      return worst < INT32_MAX;
    });
  }
  return entry->second;
}

std::int32_t ProgressInputs::worst(std::int64_t x, std::int64_t u) {
  if (x != cell_) known_.clear();
  cell_ = x;
  posts_.move_to(x);
  if (leaves_through_safe_side(u)) return INT32_MAX;
  std::vector<IndexRange> box;
  for (std::size_t i = 0; i < posts_.grid().size(); ++i) {
    const ResolvedRange range = posts_.resolved(i, u);
    if (range.all_left()) return 0;
    box.push_back(range.inside);
  }
  return worst_in(box);
}

std::int32_t ProgressInputs::limit(std::int64_t x, const std::vector<std::int64_t>& admissible) {
  if (spec_.goal_then == GoalThen::stay) {
    // What is lost in x itself follows from the equation of arrival: the best step loses no more.
    const bool is_given = spec_.controller.synthesis == Synthesis::given;
    std::int32_t best = is_given ? 0 : INT32_MAX;
    for (const std::int64_t u : admissible)
      best = is_given ? std::max(best, worst(x, u)) : std::min(best, worst(x, u));
    return best;
  }
  if (spec_.goal_then == GoalThen::come_back && arrival_(x) == 0) return INT32_MAX - 1;
  return arrival_(x) - 1;
}

std::vector<std::int64_t> ProgressInputs::of(std::int64_t x, const std::vector<std::int64_t>& admissible) {
  if (spec_.controller.synthesis == Synthesis::given) return admissible;
  std::vector<std::int64_t> result;
  const std::int32_t most = limit(x, admissible);
  for (const std::int64_t u : admissible) {
    if (worst(x, u) <= most) result.push_back(u);
  }
  return result;
}

}  // namespace coordreq
