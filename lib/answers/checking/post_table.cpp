#include "answers/checking/post_table.hpp"

#include <algorithm>
#include <set>

#include "base/requires.hpp"

namespace coordreq {
namespace {

std::int64_t first_place(const PostTable& table, const UniformGrid& grid, std::int64_t cell) {
  std::int64_t place = 0;
  for (const std::size_t j : table.states) place += grid.index(cell, j) * table.state_stride[j];
  return place;
}

}  // namespace

std::optional<std::size_t> PostTable::find(std::int64_t place) const {
  if (places.empty()) return static_cast<std::size_t>(place);
  const auto found = std::lower_bound(places.begin(), places.end(), place);
  if (found == places.end() || *found != place) return std::nullopt;
  return static_cast<std::size_t>(found - places.begin());
}

std::size_t PostTable::entry_of(const UniformGrid& grid, std::int64_t cell) const {
  const std::optional<std::size_t> found = find(first_place(*this, grid, cell));
  REQUIRES(found.has_value());
  return *found;
}

/// The index of inputs is the fastest, so that the entries of a cell lie together.
std::vector<std::int64_t> entry_places(const PostTable& table, const UniformGrid& grid,
                                       const InputSpace& inputs, const std::vector<std::int64_t>& cells) {
  std::int64_t choices = 1;
  for (const std::size_t j : table.inputs) choices *= inputs[j].count();
  std::set<std::int64_t> firsts;
  for (const std::int64_t cell : cells) firsts.insert(first_place(table, grid, cell));
  std::vector<std::int64_t> places;
  for (const std::int64_t first : firsts) {
    for (std::int64_t u = 0; u < choices; ++u) places.push_back(first + u);
  }
  return places;
}

PostTable part_of(const PostTable& whole, const UniformGrid& grid, const InputSpace& inputs,
                  const std::vector<std::int64_t>& cells) {
  if (cells.empty()) return whole;
  PostTable part = whole;
  part.places = entry_places(whole, grid, inputs, cells);
  part.entries.clear();
  for (const std::int64_t place : part.places) part.entries.push_back(whole.at(place));
  return part;
}

}  // namespace coordreq
