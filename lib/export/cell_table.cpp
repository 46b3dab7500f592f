#include "export/cell_table.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "answers/step_codes.hpp"
#include "base/process_memory.hpp"
#include "base/requires.hpp"
#include "model/odometer.hpp"

namespace coordreq {
namespace {

/// Cells of which all columns are read at a time: they take a quarter of what is left of the memory that
/// reading may take.
std::int64_t block_cells(std::optional<std::uint64_t> max_memory, std::size_t columns) {
  if (!max_memory) return kBlockCells;
  const double left = static_cast<double>(*max_memory) - memory_of_program();
  const double cells = left / 4 / static_cast<double>(sizeof(std::int32_t) * columns);
  return static_cast<std::int64_t>(std::clamp<double>(cells, 1, kBlockCells));
}

[[maybe_unused]] bool is_each_once(const TableSelection& selection) {
  std::set<std::size_t> dimensions;
  const auto is_new = [&dimensions](const auto& item) { return dimensions.insert(item.dimension).second; };
  return std::ranges::all_of(selection.slices, is_new) && std::ranges::all_of(selection.projections, is_new);
}

}  // namespace

double CellColumn::rank(std::int32_t value) const {
  return field->display.below_zero != 0 && value == field->display.below_zero ? -0.5 : value;
}

double CellColumn::number(std::int32_t value) const {
  if (field->kind == FieldKind::probability) return probability_of(value);
  return value == kUnbounded ? std::numeric_limits<double>::infinity() : value;
}

std::vector<CellColumn> cell_columns(const ResultsReader& results, std::optional<std::size_t> partition) {
  std::vector<CellColumn> columns;
  std::map<std::string, std::vector<const Field*>> by_axis;  // by leading axis
  for (const Field& field : results.fields()) {
    if (field.display.column.empty()) continue;
    if (results.leading_length(field) == 0) {
      columns.push_back({field.display.column, &field, std::nullopt});
    } else {
      by_axis[field.axes.front()].push_back(&field);
    }
  }
  for (const auto& [axis, fields] : by_axis) {
    const std::vector<std::string>& names = results.leading_names(*fields.front());
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (axis == "/partition" && partition && *partition != i) continue;
      for (const Field* const field : fields)
        columns.push_back({field->display.column + ":" + names[i], field, i});
    }
  }
  return columns;
}

double CellTable::bytes(const ResultsReader& results, const TableSelection& selection) {
  const auto columns = static_cast<double>(cell_columns(results, selection.partition).size());
  double left = 1, all = 1;
  for (std::size_t i = 0; i < results.grid().size(); ++i) {
    const auto is_this = [i](const auto& item) { return item.dimension == i; };
    const auto count = static_cast<double>(results.grid()[i].count);
    const bool is_sliced = std::ranges::any_of(selection.slices, is_this);
    all *= is_sliced ? 1 : count;
    // Projections of another kind come later.
    const auto found = std::ranges::find_if(selection.projections, is_this);
    const bool is_gone =
        found != selection.projections.end() && found->largest == selection.projections.front().largest;
    left *= is_sliced || is_gone ? 1 : count;
  }
  constexpr double kLeastBlock = 4096;
  const double projected = selection.projections.empty() ? 0 : left;
  return results.reading_bytes() +
         columns * sizeof(std::int32_t) * (projected + std::min<double>(all, kLeastBlock));
}

CellTable::CellTable(const ResultsReader& results, TableSelection selection)
    : results_(results),
      selection_(std::move(selection)),
      columns_(cell_columns(results, selection_.partition)),
      block_(all_cells(results.grid())),
      block_cells_(block_cells(results.max_memory(), columns_.size())) {
  REQUIRES(is_each_once(selection_));
  for (const TableSelection::Slice& slice : selection_.slices) {
    block_.first[slice.dimension] = slice.index;
    block_.count[slice.dimension] = 1;
  }
  for (std::size_t i = 0; i < results.grid().size(); ++i) {
    const auto is_this = [i](const TableSelection::Projection& p) { return p.dimension == i; };
    if (std::none_of(selection_.projections.begin(), selection_.projections.end(), is_this))
      kept_.push_back(i);
  }
}

/// Cuts along the first dimensions, so that blocks follow one another in row-major order.
void CellTable::for_each_block(CellBlock block, std::size_t dimension,
                               const std::function<void(const CellBlock&)>& visit) const {
  if (block.cells() <= block_cells_ || dimension == block.count.size()) {
    visit(block);
    return;
  }
  const std::int64_t first = block.first[dimension];
  const std::int64_t end = first + block.count[dimension];
  block.count[dimension] = 1;
  for (std::int64_t k = first; k < end; ++k) {
    block.first[dimension] = k;
    for_each_block(block, dimension + 1, visit);
  }
}

CellTable::Values CellTable::read(const CellBlock& block) const {
  Values values;
  for (const CellColumn& column : columns_)
    values.push_back(results_.values(*column.field, column.leading, block));
  return values;
}

void CellTable::visit_rows(const CellBlock& block, const Values& values, const Row& row) const {
  Odometer index(block.count);
  std::vector<std::int64_t> grid_index(kept_.size());
  std::vector<std::int32_t> cells(columns_.size());
  for (std::int64_t x = 0; x < block.cells(); ++x, index.advance()) {
    for (std::size_t i = 0; i < kept_.size(); ++i) grid_index[i] = block.first[kept_[i]] + index[kept_[i]];
    for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = values[c][static_cast<std::size_t>(x)];
    row(grid_index, cells);
  }
}

void CellTable::merge(std::size_t column, std::int32_t value, bool largest, std::int32_t& into,
                      bool first) const {
  const CellColumn& compared = columns_[column];
  const double found = compared.rank(value), known = compared.rank(into);
  if (first || (largest ? found > known : found < known)) into = value;
}

/// The table after all projections; `block` becomes its axes, of length 1 where it was projected.
CellTable::Values CellTable::projected(CellBlock& block) const {
  const auto& projections = selection_.projections;
  std::size_t done = 0;
  Values values;
  while (done < projections.size()) {
    // Projections of one kind that follow one another are one.
    const bool largest = projections[done].largest;
    CellBlock target = block;
    const bool from_file = done == 0;
    for (; done < projections.size() && projections[done].largest == largest; ++done) {
      target.first[projections[done].dimension] = 0;
      target.count[projections[done].dimension] = 1;
    }
    Values merged(columns_.size(), std::vector<std::int32_t>(static_cast<std::size_t>(target.cells())));
    std::vector<bool> begun(static_cast<std::size_t>(target.cells()), false);
    const auto add = [&](const CellBlock& box, const Values& found) {
      Odometer index(box.count);
      for (std::int64_t x = 0; x < box.cells(); ++x, index.advance()) {
        std::int64_t position = 0;
        for (std::size_t i = 0; i < box.count.size(); ++i) {
          const std::int64_t k = box.first[i] + index[i] - block.first[i];
          position = position * target.count[i] + (target.count[i] == 1 ? 0 : k);
        }
        const auto at = static_cast<std::size_t>(position);
        for (std::size_t c = 0; c < columns_.size(); ++c) {
          merge(c, found[c][static_cast<std::size_t>(x)], largest, merged[c][at], !begun[at]);
        }
        begun[at] = true;
      }
    };
    if (from_file) {
      for_each_block(block, 0, [&](const CellBlock& box) { add(box, read(box)); });
    } else {
      add(block, values);
    }
    values = std::move(merged);
    block = target;
  }
  return values;
}

void CellTable::for_each_row(const Row& row) const {
  if (selection_.projections.empty()) {
    for_each_block(block_, 0, [&](const CellBlock& block) { visit_rows(block, read(block), row); });
    return;
  }
  CellBlock block = block_;
  const Values values = projected(block);
  visit_rows(block, values, row);
}

}  // namespace coordreq
