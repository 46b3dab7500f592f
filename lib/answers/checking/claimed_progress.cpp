#include "answers/checking/claimed_progress.hpp"

#include <algorithm>

#include "answers/step_codes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Below the nearness of all cells of K.
constexpr std::int32_t kOutside = -1;

}  // namespace

ClaimedProgress::ClaimedProgress(const CheckContext& context)
    : context_(context),
      is_lasting_(context.spec->is_goal_lasting()),
      arrival_(context.claims->values("/arrival")) {
  for (const std::int32_t steps : arrival_) nearness_.push_back(steps < 0 ? kOutside : kUnbounded - steps);
}

bool ClaimedProgress::leaves_through_safe_side(const CheckedCell& cell, std::int64_t u) const {
  for (std::size_t i = 0; i < context_.grid->size(); ++i) {
    const GridDimension& dimension = (*context_.grid)[i];
    if (dimension.below != Outside::safe && dimension.above != Outside::safe) continue;
    const PostTable& table = *context_.posts->tables[i];
    const std::size_t entry =
        table.entry_of(*context_.grid, cell.number()) +
        static_cast<std::size_t>(context_.posts->input_offset[i][static_cast<std::size_t>(u)]);
    const IndexRange raw = table.entries[entry];
    if (dimension.below == Outside::safe && raw.first < 0) return true;
    if (dimension.above == Outside::safe && raw.last >= dimension.count) return true;
  }
  return false;
}

std::int32_t ClaimedProgress::worst(CheckedCell& cell, std::int64_t u) const {
  const std::int32_t least = cell.least(u, nearness_, kOutside);
  if (least <= 0 || leaves_through_safe_side(cell, u)) return kUnbounded;
  return kUnbounded - least;
}

std::int32_t ClaimedProgress::best(CheckedCell& cell) const {
  const bool is_given = context_.spec->controller.synthesis == Synthesis::given;
  bool is_none = true;
  std::int32_t result = is_given ? 0 : kUnbounded;
  for (std::size_t u = 0; u < cell.admitted().size(); ++u) {
    if (cell.admitted()[u] == 0) continue;
    is_none = false;
    const std::int32_t value = worst(cell, static_cast<std::int64_t>(u));
    result = is_given ? std::max(result, value) : std::min(result, value);
  }
  return is_none ? kUnbounded : result;
}

std::int32_t ClaimedProgress::limit(CheckedCell& cell) const {
  // What is lost in x itself follows from the equation of arrival: the best step loses no more.
  if (context_.spec->goal_then == GoalThen::stay) return best(cell);
  const std::int32_t value = arrival_[cell.at()];
  return is_lasting_ && value == 0 ? kUnbounded - 1 : value - 1;
}

std::vector<std::uint8_t> ClaimedProgress::of(CheckedCell& cell) const {
  std::vector<std::uint8_t> result = cell.admitted();
  if (context_.spec->controller.synthesis == Synthesis::given) return result;
  const std::int32_t most = limit(cell);
  for (std::size_t u = 0; u < result.size(); ++u) {
    if (result[u] != 0) result[u] = worst(cell, static_cast<std::int64_t>(u)) <= most ? 1 : 0;
  }
  return result;
}

}  // namespace coordreq
