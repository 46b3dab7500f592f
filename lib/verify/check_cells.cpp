#include "verify/checks.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// One object a thread.
class CellVisitor {
 public:
  CellVisitor(const CheckContext& context, const std::vector<std::unique_ptr<AnswerCheck>>& checks)
      : cell_(context) {
    for (const std::unique_ptr<AnswerCheck>& check : checks) {
      if (std::unique_ptr<CellChecker> checker = check->cell_checker())
        checkers_.push_back(std::move(checker));
    }
  }

  void visit(std::int64_t cell) {
    cell_.go_to(cell);
    for (const std::unique_ptr<CellChecker>& checker : checkers_) checker->check(cell_);
  }
  [[nodiscard]] std::int64_t looked_at() const { return cell_.looked_at(); }

 private:
  CheckedCell cell_;
  std::vector<std::unique_ptr<CellChecker>> checkers_;
};

/// The steps that checking a cell takes: all joint inputs, once for each class of each partition, and twice
/// for K.
std::int64_t steps_of_cell(const CheckContext& context) {
  std::int64_t times = 2;
  for (const PartitionSpec& partition : context.spec->coordination.partitions)
    times += static_cast<std::int64_t>(partition.classes.size()) + 1;
  return times * context.inputs->count();
}

/// Steps of such a loop, and cells looked at, for one unit.
constexpr std::int64_t kStepsOfUnit = 3;

class AllCells {
 public:
  AllCells(const CheckContext& context, const std::vector<std::unique_ptr<AnswerCheck>>& checks,
           const std::vector<std::int64_t>& cells,
           const std::function<void(std::int64_t done, std::int64_t all)>& progress, ThreadTeam& team)
      : context_(context),
        checks_(checks),
        cells_(cells),
        progress_(progress),
        team_(team),
        count_(cells.empty() ? context.grid->cells() : static_cast<std::int64_t>(cells.size())),
        visitors_(static_cast<std::size_t>(team.size())) {}

  std::int64_t run(Budget* budget) {
    if (budget == nullptr) {
      visit(0, count_);
      return done_;
    }
    const std::int64_t steps = steps_of_cell(context_);
    const std::int64_t block = std::clamp<std::int64_t>(kStepsOfBlock / steps, 16, 1 << 16);
    const std::int64_t blocks = (count_ + block - 1) / block;
    const std::int64_t stride = stride_of(blocks);
    std::int64_t number = 0;
    for (std::int64_t visited = 0; visited < blocks && !budget->is_spent(); ++visited) {
      const std::int64_t before = looked_at();
      const std::int64_t end = std::min((number + 1) * block, count_);
      visit(number * block, end);
      budget->spend((looked_at() - before + (end - number * block) * steps) / kStepsOfUnit);
      number = (number + stride) % blocks;
    }
    return done_;
  }

 private:
  static constexpr std::int64_t kStepsOfBlock = 10'000'000;

  void visit(std::int64_t first, std::int64_t end) {
    constexpr std::int64_t kGrain = 256;
    const std::int64_t grain = std::clamp<std::int64_t>((end - first) / 16, 1, kGrain);
    team_.for_each(end - first, grain, [&](ThreadTeam::Range range, int worker) {
      auto& visitor = visitors_[static_cast<std::size_t>(worker)];
      if (!visitor) visitor = std::make_unique<CellVisitor>(context_, checks_);
      for (std::int64_t i = first + range.begin; i < first + range.end; ++i)
        visitor->visit(cells_.empty() ? i : cells_[static_cast<std::size_t>(i)]);
      done_ += range.end - range.begin;
      if (worker == 0 && progress_) progress_(done_, count_);
    });
  }

  /// The distance of blocks that are visited one after the other, so that they lie all over the grid: near
  /// the golden section, and with no divisor in common, so that all are visited.
  static std::int64_t stride_of(std::int64_t blocks) {
    auto stride = static_cast<std::int64_t>(0.618 * static_cast<double>(blocks)) + 1;
    while (std::gcd(stride, blocks) != 1) ++stride;
    return stride;
  }

  [[nodiscard]] std::int64_t looked_at() const {
    std::int64_t sum = 0;
    for (const auto& visitor : visitors_) sum += visitor ? visitor->looked_at() : 0;
    return sum;
  }

  const CheckContext& context_;
  const std::vector<std::unique_ptr<AnswerCheck>>& checks_;
  const std::vector<std::int64_t>& cells_;
  const std::function<void(std::int64_t done, std::int64_t all)>& progress_;
  ThreadTeam& team_;
  std::int64_t count_;
  std::vector<std::unique_ptr<CellVisitor>> visitors_;
  std::atomic<std::int64_t> done_ = 0;
};

}  // namespace

std::int64_t check_cells(const CheckContext& context, const std::vector<std::unique_ptr<AnswerCheck>>& checks,
                         const std::vector<std::int64_t>& cells, Budget* budget,
                         const std::function<void(std::int64_t done, std::int64_t all)>& progress,
                         ThreadTeam& team) {
  return AllCells(context, checks, cells, progress, team).run(budget);
}

}  // namespace coordreq
