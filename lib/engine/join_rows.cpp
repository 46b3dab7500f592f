#include "engine/join_rows.hpp"

#include <algorithm>
#include <optional>
#include <span>

#include "base/fast_paths.hpp"
#include "engine/level_rows.hpp"
#include "engine/row_shape.hpp"

namespace coordreq {
namespace {

/// Grids of more cells occur in estimates alone; with gaps their lanes could pass 64 bits.
constexpr std::int64_t kMostCells = std::int64_t{1} << 50;

bool is_shift(const TransitionTable& table) {
  return table.shift && !table.is_sum();
}
bool is_shift(const TableShape& shape) {
  return shape.shift && !shape.sum;
}

/// How far offsets reach beyond the ends, either way; nothing if an offset is as long as the dimension.
std::optional<RowMargins> margins(std::span<const IndexRange> offsets, const GridDimension& dimension) {
  if (dimension.count < 2) return std::nullopt;
  for (const IndexRange entry : offsets) {
    if (entry.first <= -dimension.count || entry.last >= dimension.count) return std::nullopt;
    if (std::int64_t{entry.last} - entry.first + 1 >= dimension.count) return std::nullopt;
  }
  return window_margins(offsets, dimension);
}

/// True if no dimension depends on a dimension from `i` on, but for itself.
template <class Table>
bool are_alone_from(std::size_t i, const std::vector<Table>& tables) {
  for (std::size_t t = 0; t < tables.size(); ++t) {
    for (const std::int32_t state : tables[t].states) {
      if (static_cast<std::size_t>(state) >= i && static_cast<std::size_t>(state) != t) return false;
    }
  }
  return true;
}

/// @param offsets called with i: the offsets of dimension i
template <class Table, class Offsets>
UniformGrid joined(const UniformGrid& grid, const std::vector<Table>& tables, const Offsets& offsets,
                   std::size_t most) {
  if (!fast_paths().joined_rows) return grid;
  std::vector<std::int64_t> gaps;  // of all dimensions taken so far, the slowest included
  std::int64_t lanes = 1;
  for (std::size_t i = grid.size() - 1; i > 0 && gaps.size() < most; --i) {
    const auto reach = is_shift(tables[i]) ? margins(offsets(i), grid[i]) : std::nullopt;
    if (!reach || !are_alone_from(i, tables) || lanes * grid[i].count > kMostJoinedLanes) break;
    gaps.insert(gaps.begin(), reach->before + reach->after);
    lanes *= grid[i].count + gaps.front();
  }
  if (gaps.size() < 2) return grid;
  gaps.erase(gaps.begin());
  return grid.in_rows(gaps);
}

}  // namespace

RowMargins window_margins(std::span<const IndexRange> windows, const GridDimension& dimension) {
  RowMargins margins;
  for (const IndexRange window : windows) {
    const IndexRange fitted = fit_window(window, dimension.count, {dimension.below, dimension.above});
    margins.before = std::max<std::int64_t>(margins.before, -fitted.first);
    margins.after = std::max<std::int64_t>(margins.after, fitted.last);
  }
  return margins;
}

UniformGrid join_rows(const Abstraction& abstraction, std::size_t most) {
  if (!abstraction.tubes.empty()) return abstraction.grid;
  return joined(
      abstraction.grid, abstraction.tables,
      [&](std::size_t i) { return std::span(abstraction.tables[i].entries); }, most);
}

UniformGrid join_rows(const Model& model, const std::vector<IndexRange>& offsets) {
  if (model.grid().cells() > kMostCells) return model.grid();
  return joined(
      model.grid(), model.arranged_shapes(),
      [&](std::size_t i) { return std::span(&offsets[model.grid().state(i)], 1); }, model.most_along());
}

}  // namespace coordreq
