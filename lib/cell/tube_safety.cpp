#include "cell/tube_safety.hpp"

#include <algorithm>
#include <utility>

#include "answers/invariance/safe_tubes.hpp"
#include "engine/tube_sets.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kPartCells = 1 << 20;

CellSet all_safe_cells(const ResultsReader& results) {
  const UniformGrid& grid = results.grid();
  CellSet safe(grid.rows(), grid.row_length());
  for (std::int64_t begin = 0; begin < grid.cells(); begin += kPartCells) {
    const std::int64_t end = std::min(begin + kPartCells, grid.cells());
    const auto members =
        results.stretch(begin, end, [&](const CellBlock& block) { return results.safe(block); });
    for (std::int64_t x = begin; x < end; ++x) {
      if (members[static_cast<std::size_t>(x - begin)] != 0) safe.set(x);
    }
  }
  return safe;
}

std::vector<std::uint8_t> members_in(const CellSet& set, const UniformGrid& grid, const CellBlock& block) {
  std::vector<std::uint8_t> members;
  std::vector<std::int64_t> index = block.first;
  for (std::int64_t left = block.cells(); left > 0; --left) {
    std::int64_t cell = 0;
    for (std::size_t i = 0; i < index.size(); ++i) cell += index[i] * grid.stride(i);
    members.push_back(set.test(cell) ? 1 : 0);
    for (std::size_t i = index.size(); i-- > 0 && ++index[i] == block.first[i] + block.count[i];) {
      index[i] = block.first[i];
    }
  }
  return members;
}

}  // namespace

TubeSafety::TubeSafety(const ResultsReader& results, CellPosts& posts, ThreadTeam& team)
    : results_(results),
      posts_(posts),
      team_(team),
      safe_(results.grid(), [&results](const CellBlock& block) { return results.safe(block); }) {}

bool TubeSafety::passes_a_limit(std::int64_t u) const {
  const UniformGrid& grid = results_.grid();
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (coordreq::passes_a_limit(posts_.raw_tube(i, u), grid[i])) return true;
  }
  return false;
}

/// How far beyond a limit cells must be safe is a question to all tubes, so it is only asked where it
/// matters.
bool TubeSafety::demands_more_beyond_limits() {
  if (!beyond_is_known_) {
    beyond_cells_ = safe_beyond_limits(results_.spec(), posts_.whole(), all_safe_cells(results_), team_);
    if (beyond_cells_) {
      beyond_.emplace(results_.grid(), [this](const CellBlock& block) {
        return members_in(*beyond_cells_, results_.grid(), block);
      });
    }
    beyond_is_known_ = true;
  }
  return beyond_.has_value();
}

std::vector<bool> TubeSafety::keep_safe(std::vector<bool> candidates) {
  const RangeUnder tube = [this](std::size_t i, std::int64_t u) { return posts_.resolved_tube(i, u); };
  candidates = keep_inside(safe_, std::move(candidates), tube);
  std::vector<bool> passing(candidates.size(), false);
  bool any_passes = false;
  for (std::size_t u = 0; u < candidates.size(); ++u) {
    passing[u] = candidates[u] && passes_a_limit(static_cast<std::int64_t>(u));
    any_passes = any_passes || passing[u];
  }
  if (!any_passes || !demands_more_beyond_limits()) return candidates;
  const std::vector<bool> kept = keep_inside(*beyond_, passing, tube);
  for (std::size_t u = 0; u < candidates.size(); ++u) {
    if (passing[u]) candidates[u] = kept[u];
  }
  return candidates;
}

}  // namespace coordreq
