#include "verify/budget.hpp"

#include <numeric>
#include <vector>

namespace coordreq {

void answer_within(Budget& budget, std::int64_t count, std::int64_t block, ThreadTeam& team,
                   const AnswerWithin& answer, const std::function<void(std::int64_t)>& answered) {
  constexpr std::int64_t kMostGrain = 16;
  const std::int64_t grain = std::min(kMostGrain, std::max<std::int64_t>(block / 64, 1));
  for (std::int64_t begin = 0; begin < count; begin += block) {
    const Work most = budget.share(count - begin);
    std::vector<Work> used(static_cast<std::size_t>(team.size()), 0);
    team.for_each(std::min(block, count - begin), grain, [&](ThreadTeam::Range range, int worker) {
      for (std::int64_t i = range.begin; i < range.end; ++i)
        used[static_cast<std::size_t>(worker)] += answer(begin + i, most, worker);
    });
    budget.spend(std::accumulate(used.begin(), used.end(), Work{0}));
    if (answered) answered(std::min(begin + block, count));
  }
}

}  // namespace coordreq
