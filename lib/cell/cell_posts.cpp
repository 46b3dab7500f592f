#include "cell/cell_posts.hpp"

#include <algorithm>

#include "reach/affine_table.hpp"
#include "reach/build_abstraction.hpp"
#include "reach/enclosure_table.hpp"

namespace coordreq {
namespace {

bool contains(const std::vector<std::int32_t>& list, std::size_t value) {
  return std::find(list.begin(), list.end(), static_cast<std::int32_t>(value)) != list.end();
}

/// Entries to compute from which on all are computed. Sums have few, and no others hold the same ranges.
double most_entries(const ProblemSpec& spec) {
  double entries = 0;
  for (const TableShape& shape : table_shapes(spec)) {
    if (shape.sum) return 0;
    entries += shape.entries;
  }
  return entries;
}

}  // namespace

CellPosts::CellPosts(const ResultsReader& results, ThreadTeam& team)
    : results_(results), team_(team), dynamics_(results.spec()), most_entries_(most_entries(results.spec())) {
  const bool wants_tubes = results.spec().abstraction.between_samples;
  if (results.has_abstraction() && !wants_tubes) whole_ = results.abstraction();
}

void CellPosts::prepare_all() {
  if (!whole_) whole_ = build_abstraction(results_.spec(), team_);
}

const Abstraction& CellPosts::whole() {
  prepare_all();
  return *whole_;
}

void CellPosts::move_to(std::int64_t cell) {
  if (cell == cell_) return;
  if (!whole_ && entries_built_ >= most_entries_) prepare_all();
  if (!whole_) build_parts(cell);
  cell_ = cell;
}

/// Restricts the states in which the map moves: a table is then filled for their one index. The state itself
/// stays whole, because its dimension is also the one that posts lie in (and may be a periodic one), and so
/// do discrete states whose values are put in one by one: whether the system is affine is decided over all of
/// them, and must be decided as in the analysis. A state that stops stays whole, because its limits are the
/// first and the last point of its dimension.
Abstraction CellPosts::part_of(std::size_t state, std::int64_t cell) const {
  std::vector<GridDimension> dimensions = results_.grid().dimensions();
  for (std::size_t j = 0; j < dimensions.size(); ++j) {
    const bool stops = traits(dimensions[j].below).stops || traits(dimensions[j].above).stops;
    if (j == state || stops || !contains(dynamics_.dependencies(state).moving, j)) continue;
    dimensions[j].first = dimensions[j].point(results_.grid().index(cell, j));
    dimensions[j].count = 1;
  }
  Abstraction part{.grid = UniformGrid(std::move(dimensions)), .inputs = results_.inputs()};
  part.tables.resize(part.grid.size());
  if (results_.spec().abstraction.between_samples) part.tubes.resize(part.grid.size());
  return part;
}

void CellPosts::build_parts(std::int64_t cell) {
  parts_.clear();
  place_.clear();
  for (std::size_t i = 0; i < results_.grid().size(); ++i) {
    Abstraction& part = parts_.emplace_back(part_of(i, cell));
    const bool is_affine = build_affine_table(results_.spec(), dynamics_, part, i, team_).has_value();
    if (!is_affine) build_enclosure_tables(results_.spec(), dynamics_.dependencies(i), part, {i}, team_);
    std::int64_t place = 0;
    for (std::size_t j = 0; j < part.grid.size(); ++j) {
      if (part.grid[j].count > 1) place += results_.grid().index(cell, j) * part.grid.stride(j);
    }
    place_.push_back(place);
    entries_built_ += static_cast<double>(part.tables[i].entries.size());
  }
}

ResolvedRange CellPosts::resolved(std::size_t i, std::int64_t u) const {
  return whole_ ? whole_->resolved(i, cell_, u) : parts_[i].resolved(i, place_[i], u);
}

ResolvedRange CellPosts::resolved_tube(std::size_t i, std::int64_t u) const {
  return whole_ ? whole_->resolved_tube(i, cell_, u) : parts_[i].resolved_tube(i, place_[i], u);
}

IndexRange CellPosts::raw_tube(std::size_t i, std::int64_t u) const {
  return whole_ ? whole_->raw_tube(i, cell_, u) : parts_[i].raw_tube(i, place_[i], u);
}

}  // namespace coordreq
