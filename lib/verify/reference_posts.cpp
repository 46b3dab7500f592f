#include "verify/reference_posts.hpp"

#include <algorithm>

#include "answers/checking/cell_pieces.hpp"

namespace coordreq {

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
  table.positions = entry_positions(table, grid, inputs, cells);
  table.entries.resize(cells.empty() ? static_cast<std::size_t>(entries) : table.positions.size());
  return table;
}

IndexRange meeting_cells(const GridDimension& dimension, Cells cells, const Rational& lower,
                         const Rational& upper, bool upper_attained) {
  const Rational half = Rational(1) / 2;
  // In steps: cell k reaches from k - 1/2 to k + 1/2.
  const Rational low = (lower - dimension.first) / dimension.step - half;
  const Rational high = (upper - dimension.first) / dimension.step + half;
  const bool closed = cells == Cells::closed;
  const std::int64_t first = closed ? ceil_to_int(low) : floor_to_int(low) + 1;
  const std::int64_t last = closed || upper_attained ? floor_to_int(high) : ceil_to_int(high) - 1;
  return cut_to_range(dimension, first, last);
}

IndexRange with_measurements_at_limits(const GridDimension& dimension, Cells cells, IndexRange range) {
  const Rational& error = dimension.measurement_error;
  if (error == 0) return range;
  const Rational low = dimension.first;
  const Rational high = dimension.point(dimension.count - 1);
  if (dimension.below == Outside::saturate)
    range.last = std::max(range.last, meeting_cells(dimension, cells, low, low + error, true).last);
  if (dimension.above == Outside::saturate)
    range.first = std::min(range.first, meeting_cells(dimension, cells, high - error, high, true).first);
  return range;
}

}  // namespace coordreq
