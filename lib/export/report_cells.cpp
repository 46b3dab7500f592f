#include "export/report_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "base/requires.hpp"

namespace coordreq {
namespace {

using Indices = std::vector<std::int64_t>;

/// `most` of the indices of a dimension, evenly spread. @pre 1 <= most <= count
Indices spread(const GridDimension& dimension, std::int64_t most) {
  REQUIRES(1 <= most && most <= dimension.count);
  if (most == 1) return {dimension.count / 2};
  Indices indices;
  for (std::int64_t j = 0; j < most; ++j) {
    // The ends of a periodic dimension are neighbours.
    const std::int64_t k = dimension.periodic() ? j * dimension.count / most
                                                : (j * (dimension.count - 1) + (most - 1) / 2) / (most - 1);
    indices.push_back(k);
  }
  return indices;
}

/// Replaces the nearest index that is no pin itself by each pin, while there is one.
void pin(Indices& indices, const Indices& pins) {
  std::vector<bool> kept(indices.size(), false);
  for (const std::int64_t pinned : pins) {
    std::optional<std::size_t> nearest;
    for (std::size_t j = 0; j < indices.size(); ++j) {
      if (indices[j] != pinned && kept[j]) continue;
      if (!nearest || std::abs(indices[j] - pinned) < std::abs(indices[*nearest] - pinned)) nearest = j;
    }
    if (!nearest) return;
    indices[*nearest] = pinned;
    kept[*nearest] = true;
  }
}

/// The largest m >= 1 with m^n <= limit.
std::int64_t root(std::int64_t limit, std::size_t n) {
  const auto power = [n](std::int64_t m) { return std::pow(static_cast<double>(m), static_cast<double>(n)); };
  auto m = static_cast<std::int64_t>(std::pow(static_cast<double>(limit), 1.0 / static_cast<double>(n)));
  while (power(m + 1) <= static_cast<double>(limit)) ++m;
  while (m > 1 && power(m) > static_cast<double>(limit)) --m;
  return std::max<std::int64_t>(m, 1);
}

/// The numbers of indices that some dimensions get if there is room for `room` cells: as many of each as
/// possible, short dimensions in full.
void share(const UniformGrid& grid, std::vector<std::size_t> dimensions, std::int64_t& room,
           std::vector<std::int64_t>& counts) {
  std::stable_sort(dimensions.begin(), dimensions.end(),
                   [&grid](std::size_t a, std::size_t b) { return grid[a].count < grid[b].count; });
  for (std::size_t n = dimensions.size(); n > 0; --n) {
    const std::size_t i = dimensions[dimensions.size() - n];
    counts[i] = std::min(grid[i].count, root(room, n));
    room /= counts[i];
  }
}

ReportCells cells_of_pair(const UniformGrid& grid, std::size_t x, std::size_t y, std::int64_t room,
                          const std::vector<std::vector<std::int64_t>>& pins) {
  std::vector<std::size_t> pair = {x}, others;
  if (y != x) pair.push_back(y);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (i != x && i != y) others.push_back(i);
  }
  std::vector<std::int64_t> counts(grid.size());
  share(grid, pair, room, counts);
  share(grid, others, room, counts);
  ReportCells cells;
  cells.shows.emplace(x, y);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    cells.indices.push_back(spread(grid[i], counts[i]));
    if (i == x || i == y) continue;
    Indices pinned;
    for (const std::vector<std::int64_t>& cell : pins) pinned.push_back(cell[i]);
    pin(cells.indices.back(), pinned);
    std::sort(cells.indices.back().begin(), cells.indices.back().end());
  }
  return cells;
}

ReportCells whole(const UniformGrid& grid) {
  ReportCells cells;
  for (const GridDimension& dimension : grid.dimensions()) {
    cells.indices.emplace_back(static_cast<std::size_t>(dimension.count));
    std::iota(cells.indices.back().begin(), cells.indices.back().end(), std::int64_t{0});
  }
  return cells;
}

}  // namespace

std::int64_t ReportCells::count() const {
  std::int64_t product = 1;
  for (const Indices& dimension : indices) product *= static_cast<std::int64_t>(dimension.size());
  return product;
}

std::vector<ReportCells> choose_cells(const UniformGrid& grid, std::int64_t most,
                                      const std::vector<std::vector<std::int64_t>>& pins) {
  REQUIRES(most >= 1);
  if (grid.cells() <= most) return {whole(grid)};
  if (grid.size() == 1) return {cells_of_pair(grid, 0, 0, most, pins)};
  std::vector<ReportCells> all;
  const auto pairs = static_cast<std::int64_t>(grid.size() * (grid.size() - 1) / 2);
  for (std::size_t x = 0; x < grid.size(); ++x) {
    for (std::size_t y = x + 1; y < grid.size(); ++y)
      all.push_back(cells_of_pair(grid, x, y, std::max<std::int64_t>(most / pairs, 1), pins));
  }
  return all;
}

}  // namespace coordreq
