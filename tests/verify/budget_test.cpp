#include "verify/budget.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/analysed_file.hpp"

namespace coordreq {
namespace {

/// Questions that take up to 9 units, if they may. @returns what each took
std::vector<Work> answered(Work all, int threads) {
  ThreadTeam team(threads);
  Budget budget(all);
  std::vector<Work> used(500);
  answer_within(budget, 500, 64, team, [&](std::int64_t i, Work most, int) {
    return used[static_cast<std::size_t>(i)] = std::min<Work>(most, i % 10);
  });
  return used;
}

TEST(Budget, EndsAtTheSameQuestionWhateverTheNumberOfThreads) {
  for (const Work all : {0, 100, 600, 100000}) EXPECT_EQ(answered(all, 1), answered(all, 3)) << all;
}

TEST(Budget, IsSharedByWhatIsLeft) {
  EXPECT_EQ(Budget(1000).share(100), 9);  // of 938
  EXPECT_EQ(Budget(1000).share(2), 50);   // a twentieth
  EXPECT_EQ(Budget(1000).share(100000), 1);
  EXPECT_EQ(Budget(0).share(1), 0);
}

TEST(Budget, IsEnoughForWhatIsBegunWhenSharesAreSpent) {
  ThreadTeam team(1);
  for (const Work all : {5000, 100000}) {
    Budget budget(all);
    const Work begun = budget.of_begun(64);
    answer_within(budget, 500, 64, team,
                  [&](std::int64_t, Work most, int) { return most == 0 ? 0 : most + begun; });
    EXPECT_LE(budget.spent(), all);
    EXPECT_GT(budget.spent(), all / 2);
  }
}

TEST(Budget, DecidesWhatIsConfirmedAndThreadsDoNot) {
  const std::string spec = R"json({"coordreq": 1, "name": "bends",
"states": [{"name": "x", "lower": -2, "upper": 2, "step": 0.5}, {"name": "y", "lower": -2, "upper": 2, "step": 0.5}],
"inputs": [{"name": "u", "values": [-1, 1]}], "agents": [{"name": "a", "inputs": ["u"]}],
"dynamics": {"time": "continuous", "period": 0.5, "equations": {"x": "y", "y": "(1 - x^2)*y - x + u"}},
"safe": "true"})json";
  std::vector<std::int64_t> confirmed;
  ThreadTeam one(1);
  ThreadTeam three(3);
  const ClaimedFile file = analysed_file(spec, one);
  for (const double seconds : {0.0, 0.02, 0.2, 20.0}) {
    const VerifyOptions options{.sample = {}, .budget_seconds = seconds, .progress = {}};
    const Verification alone = verify_file(file, options, one);
    const Verification together = verify_file(file, options, three);
    EXPECT_EQ(alone.confirmed, together.confirmed) << seconds;
    EXPECT_EQ(complaints(alone), "");
    confirmed.push_back(alone.confirmed);
  }
  EXPECT_EQ(confirmed.front(), 0);
  EXPECT_LT(confirmed[1], confirmed.back());
}

}  // namespace
}  // namespace coordreq
