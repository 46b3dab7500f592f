#include "answers/goal/check_lasting.hpp"

#include <algorithm>
#include <iterator>

#include "answers/checking/claimed_values.hpp"
#include "answers/checking/comparison.hpp"
#include "answers/step_codes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

void raise(std::atomic<std::int32_t>& greatest, std::int32_t value) {
  std::int32_t before = greatest.load();
  while (before < value && !greatest.compare_exchange_weak(before, value)) {
  }
}

}  // namespace

LastingCheck::LastingCheck(const CheckContext& context)
    : context_(context),
      arrival_(context.claims->values("/arrival")),
      is_goal_(arrival_.size(), 0),
      least_("arrival cannot be less") {}

bool LastingCheck::is_return() const {
  return context_.spec->goal_then == GoalThen::come_back;
}

LastingCheck::Judged LastingCheck::judge(const CheckedCell& cell, std::int32_t claimed, SafeVerdict verdict,
                                         std::int32_t best) {
  const bool can_be_in = verdict != SafeVerdict::unsafe;
  const bool can_be_out = verdict != SafeVerdict::safe;
  const std::int32_t in_goal = is_return() && best != kUnbounded ? 0 : best;
  const std::int32_t outside = one_more(best);
  const bool fits_in = can_be_in && claimed == in_goal;
  ++cells_;
  if (!can_be_out) ++sure_;
  if (can_be_in) ++possible_;
  if (verdict == SafeVerdict::open) ++open_;
  // Where both are the same, nothing can be forced: to count as the goal is then the harder case to refute.
  const bool is_in = fits_in || !can_be_out;
  is_goal_[cell.at()] = is_in ? 1 : 0;
  const bool is_unproven = fits_in && verdict == SafeVerdict::open && in_goal != outside;
  return {is_in ? in_goal : outside, is_unproven};
}

void LastingCheck::add_step(std::int32_t best, std::int32_t worst) {
  raise(longest_return_, one_more(best));
  raise(longest_gap_, one_more(worst));
}

/// The cells of a list for which a test holds, by all threads.
template <class Test>
std::vector<std::int64_t> LastingCheck::those(const std::vector<std::int64_t>& cells, ThreadTeam& team,
                                              const Test& test) const {
  std::vector<std::uint8_t> holds(cells.size(), 0);
  team.for_each(std::ssize(cells), 512, [&](ThreadTeam::Range range, int) {
    CheckedCell cell(context_);
    const ClaimedProgress progress(context_);
    const bool is_given = context_.spec->controller.synthesis == Synthesis::given;
    for (std::int64_t k = range.begin; k < range.end; ++k) {
      const auto i = static_cast<std::size_t>(k);
      cell.go_to(cells[i]);
      bool some = false, every = true;
      for (std::size_t u = 0; u < cell.admitted().size(); ++u) {
        if (cell.admitted()[u] == 0) continue;
        const auto input = static_cast<std::int64_t>(u);
        const bool is_kept = !progress.leaves_through_safe_side(cell, input) && test(cell, input);
        some = some || is_kept;
        every = every && is_kept;
      }
      holds[i] = some && (every || !is_given) ? 1 : 0;
    }
  });
  std::vector<std::int64_t> result;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (holds[i] != 0) result.push_back(cells[i]);
  }
  return result;
}

/// Cells of G with arrival above 0 from which the world cannot force a sample outside G after which as many
/// are still to come. (Outside G the equation of arrival says that it can force one sample less.)
std::vector<std::int64_t> LastingCheck::not_forced(ThreadTeam& team) const {
  std::vector<std::int32_t> nearness(arrival_.size(), kUnbounded);  // of what the world wants to come to
  std::vector<std::int64_t> open;
  for (std::size_t x = 0; x < arrival_.size(); ++x) {
    if (arrival_[x] <= 0) continue;
    if (is_goal_[x] != 0) {
      open.push_back(static_cast<std::int64_t>(x));
    } else {
      nearness[x] = kUnbounded - arrival_[x];
    }
  }
  while (true) {
    const std::vector<std::int64_t> left = those(open, team, [&](CheckedCell& cell, std::int64_t u) {
      return cell.least(u, nearness, -1) > kUnbounded - arrival_[cell.at()];
    });
    if (left.size() == open.size()) return open;
    std::vector<std::int64_t> forced;
    std::set_difference(open.begin(), open.end(), left.begin(), left.end(), std::back_inserter(forced));
    for (const std::int64_t x : forced)
      nearness[static_cast<std::size_t>(x)] = kUnbounded - arrival_[static_cast<std::size_t>(x)];
    open = left;
  }
}

/// Cells of K outside W that could be in W: from which a cell of G, whose own step stays among W and such
/// cells, can be forced.
std::vector<std::int64_t> LastingCheck::not_lost(ThreadTeam& team) const {
  std::vector<std::int64_t> kept;
  std::vector<std::uint8_t> in_whole(arrival_.size(), 0), winning(arrival_.size(), 0);
  for (std::size_t x = 0; x < arrival_.size(); ++x) {
    if (arrival_[x] == kUnbounded) kept.push_back(static_cast<std::int64_t>(x));
    if (arrival_[x] >= 0) in_whole[x] = 1;
    if (arrival_[x] >= 0 && arrival_[x] != kUnbounded) winning[x] = 1;
  }
  while (true) {
    std::vector<std::uint8_t> reached = winning;
    std::vector<std::int64_t> all, rest = kept;
    while (true) {
      const std::vector<std::int64_t> more = those(rest, team, [&](CheckedCell& cell, std::int64_t u) {
        if (is_goal_[cell.at()] != 0) return cell.least(u, in_whole, 0) > 0;
        return cell.least(u, reached, 0) > 0;
      });
      if (more.empty()) break;
      for (const std::int64_t x : more) reached[static_cast<std::size_t>(x)] = 1;
      std::vector<std::int64_t> others;
      std::set_difference(rest.begin(), rest.end(), more.begin(), more.end(), std::back_inserter(others));
      all.insert(all.end(), more.begin(), more.end());
      rest = std::move(others);
    }
    std::sort(all.begin(), all.end());
    if (all.size() == kept.size()) return kept;
    for (const std::int64_t x : rest) in_whole[static_cast<std::size_t>(x)] = 0;
    kept = std::move(all);
  }
}

void LastingCheck::check_all(ThreadTeam& team) {
  if (!context_.is_full) return;
  least_.add_checked(cells_);
  for (const std::int64_t x : is_return() ? not_lost(team) : not_forced(team)) {
    if (context_.sound_only() || open_ > 0) {
      least_.add_unproven();
      continue;
    }
    CheckedCell cell(context_);
    cell.go_to(x);
    least_.add_wrong(x, [&] { return cell.location() + ": could be less"; });
  }
}

/// Figures of the file that follow from the cells; nothing is compared if some were not looked at.
Finding LastingCheck::figures() const {
  Comparison result("goal figures");
  const Claims& claims = *context_.claims;
  const std::int64_t all = std::ranges::count_if(arrival_, [](std::int32_t steps) { return steps >= 0; });
  if (cells_ != all) return result.finding();
  const auto cells = static_cast<std::int64_t>(claims.attribute("/arrival", "goal_cells"));
  result.expect("|G|", cells, std::clamp(cells, sure_.load(), possible_.load()));
  if (!is_return()) return result.finding();
  const auto compare = [&](const char* name, const std::atomic<std::int32_t>& value) {
    result.expect(name, static_cast<std::int64_t>(claims.attribute("/arrival", name)),
                  std::int64_t{value.load()});
  };
  compare("longest_return", longest_return_);
  compare("longest_gap", longest_gap_);
  return result.finding();
}

std::vector<Finding> LastingCheck::findings() const {
  std::vector<Finding> result = {figures()};
  if (context_.is_full) result.push_back(least_.finding());
  return result;
}

}  // namespace coordreq
