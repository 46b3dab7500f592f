#include "export/cell_table.hpp"

#include <algorithm>
#include <utility>

#include "answers/layers/trigger_table.hpp"
#include "model/odometer.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kPartCells = 1 << 20;

double plain_rank(std::int32_t value) {
  return value;
}

/// A connection that must stand already is worse than any countdown and better than being lost.
double trigger_rank(std::int32_t value) {
  return value == TriggerTable::kMustBeConnected ? -0.5 : value;
}

std::vector<std::int32_t> widened(const std::vector<std::uint8_t>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

std::vector<CellColumn> cell_columns(const ResultsReader& results, std::optional<std::size_t> partition) {
  std::vector<CellColumn> columns;
  columns.push_back(
      {"safe", [&results](const CellBlock& b) { return widened(results.safe(b)); }, plain_rank});
  columns.push_back(
      {"invariant", [&results](const CellBlock& b) { return widened(results.invariant(b)); }, plain_rank});
  columns.push_back(
      {"collision_time", [&results](const CellBlock& b) { return results.collision_time(b); }, plain_rank});
  for (std::size_t p = 0; p < results.partitions().size(); ++p) {
    if (partition && *partition != p) continue;
    const std::string& name = results.partitions()[p].name;
    columns.push_back(
        {"delay:" + name, [&results, p](const CellBlock& b) { return results.delay(p, b); }, plain_rank});
    columns.push_back({"countdown:" + name,
                       [&results, p](const CellBlock& b) { return results.trigger(p, b); }, trigger_rank});
  }
  return columns;
}

CellTable::CellTable(const ResultsReader& results, TableSelection selection)
    : results_(results),
      selection_(std::move(selection)),
      columns_(cell_columns(results, selection_.partition)),
      block_(all_cells(results.grid())) {
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

/// Cuts along the first dimensions, so that parts follow one another in row-major order.
void CellTable::for_each_part(CellBlock block, std::size_t dimension,
                              const std::function<void(const CellBlock&)>& visit) const {
  if (block.cells() <= kPartCells || dimension == block.count.size()) {
    visit(block);
    return;
  }
  const std::int64_t first = block.first[dimension];
  const std::int64_t end = first + block.count[dimension];
  block.count[dimension] = 1;
  for (std::int64_t k = first; k < end; ++k) {
    block.first[dimension] = k;
    for_each_part(block, dimension + 1, visit);
  }
}

CellTable::Values CellTable::read(const CellBlock& part) const {
  Values values;
  for (const CellColumn& column : columns_) values.push_back(column.read(part));
  return values;
}

void CellTable::visit_rows(const CellBlock& block, const Values& values, const Row& row) const {
  Odometer index(block.count);
  std::vector<std::int64_t> shown(kept_.size());
  std::vector<std::int32_t> cells(columns_.size());
  for (std::int64_t x = 0; x < block.cells(); ++x, index.advance()) {
    for (std::size_t i = 0; i < kept_.size(); ++i) shown[i] = block.first[kept_[i]] + index[kept_[i]];
    for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = values[c][static_cast<std::size_t>(x)];
    row(shown, cells);
  }
}

void CellTable::merge(std::size_t column, std::int32_t value, bool largest, std::int32_t& into,
                      bool first) const {
  const auto rank = columns_[column].rank;
  if (first || (largest ? rank(value) > rank(into) : rank(value) < rank(into))) into = value;
}

/// The table after all projections; `block` becomes what it is over, with length 1 where it was projected.
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
    const auto add = [&](const CellBlock& part, const Values& found) {
      Odometer index(part.count);
      for (std::int64_t x = 0; x < part.cells(); ++x, index.advance()) {
        std::int64_t place = 0;
        for (std::size_t i = 0; i < part.count.size(); ++i) {
          const std::int64_t k = part.first[i] + index[i] - block.first[i];
          place = place * target.count[i] + (target.count[i] == 1 ? 0 : k);
        }
        const auto at = static_cast<std::size_t>(place);
        for (std::size_t c = 0; c < columns_.size(); ++c) {
          merge(c, found[c][static_cast<std::size_t>(x)], largest, merged[c][at], !begun[at]);
        }
        begun[at] = true;
      }
    };
    if (from_file) {
      for_each_part(block, 0, [&](const CellBlock& part) { add(part, read(part)); });
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
    for_each_part(block_, 0, [&](const CellBlock& part) { visit_rows(part, read(part), row); });
    return;
  }
  CellBlock block = block_;
  const Values values = projected(block);
  visit_rows(block, values, row);
}

}  // namespace coordreq
