#include "verify/check_cells.hpp"

#include <atomic>
#include <utility>

namespace coordreq {
namespace {

/// One object a thread.
class CellVisitor {
 public:
  CellVisitor(const CheckGround& ground, const std::vector<std::unique_ptr<AnswerCheck>>& checks)
      : cell_(ground) {
    for (const std::unique_ptr<AnswerCheck>& check : checks) {
      if (std::unique_ptr<CellChecker> checker = check->cell_checker())
        checkers_.push_back(std::move(checker));
    }
  }

  void visit(std::int64_t cell) {
    cell_.go_to(cell);
    for (const std::unique_ptr<CellChecker>& checker : checkers_) checker->check(cell_);
  }

 private:
  CheckedCell cell_;
  std::vector<std::unique_ptr<CellChecker>> checkers_;
};

}  // namespace

void check_cells(const CheckGround& ground, const std::vector<std::unique_ptr<AnswerCheck>>& checks,
                 const std::vector<std::int64_t>& cells,
                 const std::function<void(std::int64_t done, std::int64_t all)>& progress, ThreadTeam& team) {
  constexpr std::int64_t kGrain = 256;
  std::vector<std::unique_ptr<CellVisitor>> visitors(static_cast<std::size_t>(team.size()));
  const bool all = cells.empty();
  const std::int64_t count = all ? ground.grid->cells() : static_cast<std::int64_t>(cells.size());
  std::atomic<std::int64_t> done = 0;
  team.for_each(count, kGrain, [&](ThreadTeam::Range range, int worker) {
    auto& visitor = visitors[static_cast<std::size_t>(worker)];
    if (!visitor) visitor = std::make_unique<CellVisitor>(ground, checks);
    for (std::int64_t i = range.begin; i < range.end; ++i)
      visitor->visit(all ? i : cells[static_cast<std::size_t>(i)]);
    done += range.end - range.begin;
    if (worker == 0 && progress) progress(done, count);
  });
}

}  // namespace coordreq
