#include "answers/checking/post_table.hpp"

#include <algorithm>
#include <set>

#include "base/requires.hpp"

namespace coordreq {
namespace {

std::int64_t first_position(const PostTable& table, const UniformGrid& grid, std::int64_t cell) {
  std::int64_t position = 0;
  for (const std::size_t j : table.states) position += grid.index(cell, j) * table.state_stride[j];
  return position;
}

}  // namespace

std::optional<std::size_t> PostTable::find(std::int64_t position) const {
  if (positions.empty()) return static_cast<std::size_t>(position);
  const auto found = std::lower_bound(positions.begin(), positions.end(), position);
  if (found == positions.end() || *found != position) return std::nullopt;
  return static_cast<std::size_t>(found - positions.begin());
}

std::size_t PostTable::entry_of(const UniformGrid& grid, std::int64_t cell) const {
  const std::optional<std::size_t> found = find(first_position(*this, grid, cell));
  REQUIRES(found.has_value());
  return *found;
}

/// The index of inputs is the fastest, so that the entries of a cell lie together.
std::vector<std::int64_t> entry_positions(const PostTable& table, const UniformGrid& grid,
                                          const InputSpace& inputs, const std::vector<std::int64_t>& cells) {
  std::int64_t choices = 1;
  for (const std::size_t j : table.inputs) choices *= inputs[j].count();
  std::set<std::int64_t> firsts;
  for (const std::int64_t cell : cells) firsts.insert(first_position(table, grid, cell));
  std::vector<std::int64_t> positions;
  for (const std::int64_t first : firsts) {
    for (std::int64_t u = 0; u < choices; ++u) positions.push_back(first + u);
  }
  return positions;
}

PostTable subset_of(const PostTable& whole, const UniformGrid& grid, const InputSpace& inputs,
                    const std::vector<std::int64_t>& cells) {
  if (cells.empty()) return whole;
  PostTable subset = whole;
  subset.positions = entry_positions(whole, grid, inputs, cells);
  subset.entries.clear();
  for (const std::int64_t position : subset.positions) subset.entries.push_back(whole.at(position));
  return subset;
}

}  // namespace coordreq
