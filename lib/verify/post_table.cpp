#include "verify/post_table.hpp"

#include <algorithm>
#include <set>

#include "model/pieces.hpp"

namespace coordreq {

namespace {

std::int64_t first_place(const PostTable& table, const UniformGrid& grid, std::int64_t cell) {
  std::int64_t place = 0;
  for (const std::size_t j : table.states) place += grid.index(cell, j) * table.state_stride[j];
  return place;
}

/// Inputs run fastest, so that entries of a cell lie together.
std::vector<std::int64_t> places_of(const PostTable& table, const UniformGrid& grid, const InputSpace& inputs,
                                    const std::vector<std::int64_t>& cells) {
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

}  // namespace

std::optional<std::size_t> PostTable::find(std::int64_t place) const {
  if (places.empty()) return static_cast<std::size_t>(place);
  const auto found = std::lower_bound(places.begin(), places.end(), place);
  if (found == places.end() || *found != place) return std::nullopt;
  return static_cast<std::size_t>(found - places.begin());
}

std::size_t PostTable::entry_of(const UniformGrid& grid, std::int64_t cell) const {
  return *find(first_place(*this, grid, cell));
}

PostTable empty_table(const UniformGrid& grid, const InputSpace& inputs, const Influences& influences,
                      const std::vector<std::int64_t>& cells) {
  PostTable table{.states = influences.moving, .inputs = influences.inputs};
  table.states.insert(table.states.end(), influences.parameters.begin(), influences.parameters.end());
  std::sort(table.states.begin(), table.states.end());
  table.state_stride.assign(grid.size(), 0);
  table.input_stride.assign(inputs.size(), 0);
  std::int64_t entries = 1;
  for (auto j = table.inputs.rbegin(); j != table.inputs.rend(); ++j) {
    table.input_stride[*j] = entries;
    entries *= inputs[*j].count();
  }
  for (auto j = table.states.rbegin(); j != table.states.rend(); ++j) {
    table.state_stride[*j] = entries;
    entries *= grid[*j].count;
  }
  table.places = places_of(table, grid, inputs, cells);
  table.entries.resize(cells.empty() ? static_cast<std::size_t>(entries) : table.places.size());
  return table;
}

PostTable part_of(const PostTable& whole, const UniformGrid& grid, const InputSpace& inputs,
                  const std::vector<std::int64_t>& cells) {
  if (cells.empty()) return whole;
  PostTable part = whole;
  part.places = places_of(whole, grid, inputs, cells);
  part.entries.clear();
  for (const std::int64_t place : part.places) part.entries.push_back(whole.at(place));
  return part;
}

IndexRange cells_met(const GridDimension& dimension, Cells cells, const Rational& lower,
                     const Rational& upper, bool upper_attained) {
  const Rational half = Rational(1) / 2;
  // In steps: cell k reaches from k - 1/2 to k + 1/2.
  const Rational low = (lower - dimension.first) / dimension.step - half;
  const Rational high = (upper - dimension.first) / dimension.step + half;
  const bool closed = cells == Cells::closed;
  const std::int64_t first = closed ? ceil_to_int(low) : floor_to_int(low) + 1;
  const std::int64_t last = closed || upper_attained ? floor_to_int(high) : ceil_to_int(high) - 1;
  return raw_range(dimension, first, last);
}

IndexRange with_measurements_at_limits(const GridDimension& dimension, Cells cells, IndexRange range) {
  const Rational& error = dimension.measurement_error;
  if (error == 0) return range;
  const Rational low = dimension.first;
  const Rational high = dimension.point(dimension.count - 1);
  if (dimension.below == Outside::saturate)
    range.last = std::max(range.last, cells_met(dimension, cells, low, low + error, true).last);
  if (dimension.above == Outside::saturate)
    range.first = std::min(range.first, cells_met(dimension, cells, high - error, high, true).first);
  return range;
}

}  // namespace coordreq
