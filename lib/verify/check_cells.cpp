#include "verify/check_cells.hpp"

#include <atomic>
#include <memory>

#include "verify/cell_checker.hpp"

namespace coordreq {

std::vector<Finding> check_cells(const CellCheck& check, ThreadTeam& team) {
  constexpr std::int64_t kGrain = 256;
  CellTallies tallies(check);
  SafeMemory memory(*check.spec, *check.grid);
  std::vector<std::unique_ptr<CellChecker>> checkers(static_cast<std::size_t>(team.size()));
  const bool all = check.cells.empty();
  const std::int64_t count = all ? check.grid->cells() : static_cast<std::int64_t>(check.cells.size());
  std::atomic<std::int64_t> done = 0;
  team.for_each(count, kGrain, [&](ThreadTeam::Range range, int worker) {
    auto& checker = checkers[static_cast<std::size_t>(worker)];
    if (!checker) checker = std::make_unique<CellChecker>(check, tallies, memory);
    for (std::int64_t i = range.begin; i < range.end; ++i)
      checker->check(all ? i : check.cells[static_cast<std::size_t>(i)]);
    done += range.end - range.begin;
    if (worker == 0 && check.progress) check.progress(done, count);
  });
  return tallies.findings();
}

}  // namespace coordreq
