#include "cell/safe_beyond_file.hpp"

#include <algorithm>

#include "answers/invariance/safe_tubes.hpp"
#include "answers/paths.hpp"
#include "base/requires.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

CellSet all_safe_cells(const ResultsReader& results) {
  const UniformGrid& grid = results.grid();
  CellSet safe(grid.rows(), grid.row_length());
  for (std::int64_t begin = 0; begin < grid.cells(); begin += kBlockCells) {
    const std::int64_t end = std::min(begin + kBlockCells, grid.cells());
    const auto members = results.read_run(
        begin, end, [&](const CellBlock& block) { return results.members(paths::kSafe, block); });
    for (std::int64_t x = begin; x < end; ++x) {
      if (members[static_cast<std::size_t>(x - begin)] != 0) safe.set(x);
    }
  }
  return safe;
}

}  // namespace

SafeBeyondFile::SafeBeyondFile(const ResultsReader& results, CellPosts& posts, ThreadTeam& team)
    : results_(results), posts_(posts), team_(team) {
  REQUIRES(results.spec().abstraction.between_samples);
}

CellMembers* SafeBeyondFile::members() {
  if (!is_known_) {
    cells_ = safe_beyond_limits(results_.spec(), posts_.whole(), all_safe_cells(results_), team_);
    if (cells_) members_.emplace(results_.grid(), [this](std::int64_t cell) { return cells_->test(cell); });
    is_known_ = true;
  }
  return members_ ? &*members_ : nullptr;
}

}  // namespace coordreq
