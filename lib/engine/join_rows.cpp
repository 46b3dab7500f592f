#include "engine/join_rows.hpp"

#include <algorithm>
#include <optional>

#include "engine/level_rows.hpp"
#include "engine/row_shape.hpp"

namespace coordreq {
namespace {

/// As far as the offsets of a dimension go, either way; nothing if it does not move by offsets alone, or
/// farther than it is long.
std::optional<RowMargins> margins(const TransitionTable& table, const GridDimension& dimension) {
  if (!table.shift || table.is_sum() || dimension.count < 2) return std::nullopt;
  const RowEnds ends{dimension.below, dimension.above};
  RowMargins result;
  for (const IndexRange entry : table.entries) {
    if (entry.first <= -dimension.count || entry.last >= dimension.count) return std::nullopt;
    if (std::int64_t{entry.last} - entry.first + 1 >= dimension.count) return std::nullopt;
    const IndexRange window = fit_window(entry, dimension.count, ends);
    result.before = std::max<std::int64_t>(result.before, -window.first);
    result.after = std::max<std::int64_t>(result.after, window.last);
  }
  return result;
}

}  // namespace

UniformGrid join_rows(const Abstraction& abstraction, std::size_t most) {
  const UniformGrid& grid = abstraction.grid;
  if (!abstraction.tubes.empty()) return grid;
  std::vector<std::int64_t> gaps;  // of all dimensions taken so far, the first one too
  std::int64_t lanes = 1;
  for (std::size_t i = grid.size() - 1; i > 0 && gaps.size() < most; --i) {
    const auto own = margins(abstraction.tables[i], grid[i]);
    if (!own || !are_alone_from(i, abstraction.tables) || lanes * grid[i].count > kMostJoinedLanes) break;
    gaps.insert(gaps.begin(), own->before + own->after);
    lanes *= grid[i].count + gaps.front();
  }
  if (gaps.size() < 2) return grid;
  gaps.erase(gaps.begin());
  return grid.in_rows(gaps);
}

}  // namespace coordreq
