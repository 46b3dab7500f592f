// Tables with entries for every cell are cut as the cells are.

#include <gtest/gtest.h>

#include <map>
#include <mutex>

#include "answers/answers.hpp"
#include "answers/context/answer.hpp"
#include "answers/plan.hpp"
#include "reach/build_abstraction.hpp"
#include "spec/read_spec.hpp"
#include "support/thread_ranks.hpp"

namespace coordreq {
namespace {

/// The table of a is by cells; b is a shift on which no other state depends; the table of c is over c alone.
ProblemSpec coupled() {
  return read_spec(R"json({"coordreq": 1, "name": "coupled",
    "states": [{"name": "a", "lower": 0, "upper": 8, "step": 1, "outside": "saturate"},
               {"name": "b", "lower": 0, "upper": 6, "step": 1, "outside": "saturate"},
               {"name": "c", "lower": 0, "upper": 4, "step": 1, "outside": "saturate"}],
    "inputs": [{"name": "u", "values": [-1, 0, 2]}], "agents": [{"name": "one", "inputs": ["u"]}],
    "dynamics": {"time": "discrete", "period": 1,
                 "equations": {"a": "a * b * c / 100 + u", "b": "b + u", "c": "c * c / 4"}},
    "safe": "a + b >= 1"})json",
                   "coupled");
}

TEST(DividedTables, HoldWhatTheRowsOfARankNeed) {
  const ProblemSpec spec = coupled();
  const Model model = make_model(spec);
  ThreadTeam one(1);
  const Abstraction whole = arranged(build_abstraction(spec, one), model.order());
  constexpr int kRanks = 4;
  std::mutex mutex;
  std::map<int, std::size_t> entries;
  ThreadRanks::run(kRanks, [&](Ranks& ranks) {
    ThreadTeam team(2);
    Answers answers(model, &ranks);
    run_stages(context_answer.stages(spec), answers, {.team = team});
    const AnalysisContext& context = answers.context;
    const Abstraction& local = *context.abstraction;
    const std::size_t a = local.grid.dimension_of(0), c = local.grid.dimension_of(2);
    const RowShare::Range rows = context.share->local();
    const std::int64_t cells = (rows.end - rows.begin) * local.grid.row_length();
    EXPECT_EQ(std::ssize(local.tables[a].entries), 3 * cells);
    EXPECT_EQ(std::ssize(context.engine->slices()[a].ids), 3 * (rows.end - rows.begin));
    EXPECT_EQ(local.tables[c].entries.size(), whole.tables[c].entries.size());
    for (std::int64_t x = rows.begin * local.grid.row_length(); x < rows.end * local.grid.row_length(); ++x) {
      for (std::int64_t u = 0; u < 3; ++u) {
        for (std::size_t i = 0; i < local.grid.size(); ++i) EXPECT_EQ(local.raw(i, x, u), whole.raw(i, x, u));
      }
    }
    const std::lock_guard lock(mutex);
    entries[ranks.rank()] = local.tables[a].entries.size();
  });
  std::size_t sum = 0, most = 0;
  for (const auto& [rank, count] : entries) {
    sum += count;
    most = std::max(most, count);
  }
  EXPECT_EQ(sum, whole.tables[whole.grid.dimension_of(0)].entries.size());
  EXPECT_LT(most, sum / 2);
}

}  // namespace
}  // namespace coordreq
