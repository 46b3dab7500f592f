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
    : grid_(&results.grid()),
      file_(std::make_unique<File>(
          File{results, team, AffineDynamics(results.spec()), most_entries(results.spec()), {}, {}, 0, {}})) {
  if (!results.has_abstraction() || has_tubes()) return;
  file_->whole = results.abstraction();
  whole_ = &*file_->whole;
}

const Abstraction& CellPosts::whole() {
  if (whole_ == nullptr) {
    file_->whole = build_abstraction(file_->results.spec(), file_->team);
    whole_ = &*file_->whole;
  }
  return *whole_;
}

const std::vector<std::int32_t>& CellPosts::inputs_of(std::size_t i) const {
  return file_ ? file_->dynamics.dependencies(i).inputs : whole_->tables[i].inputs;
}

bool CellPosts::has_tubes() const {
  return file_ ? file_->results.spec().abstraction.between_samples : !whole_->tubes.empty();
}

void CellPosts::move_to(std::int64_t cell) {
  if (cell == cell_) return;
  if (whole_ == nullptr && file_->entries_built >= file_->most_entries) prepare_all();
  if (whole_ == nullptr) build_parts(cell);
  cell_ = cell;
}

/// Restricts the states in which the map moves: a table is then filled for their one index. The state itself
/// stays whole, because its dimension is also the one that posts lie in (and may be a periodic one), and so
/// do discrete states whose values are put in one by one: whether the system is affine is decided over all of
/// them, and must be decided as in the analysis. A state that stops stays whole, because its limits are the
/// first and the last point of its dimension.
Abstraction CellPosts::part_of(std::size_t state, std::int64_t cell) const {
  std::vector<GridDimension> dimensions = grid_->dimensions();
  for (std::size_t j = 0; j < dimensions.size(); ++j) {
    const bool stops = traits(dimensions[j].below).stops || traits(dimensions[j].above).stops;
    if (j == state || stops || !contains(file_->dynamics.dependencies(state).moving, j)) continue;
    dimensions[j].first = dimensions[j].point(grid_->index(cell, j));
    dimensions[j].count = 1;
  }
  Abstraction part{.grid = UniformGrid(std::move(dimensions)), .inputs = file_->results.inputs()};
  part.tables.resize(part.grid.size());
  if (has_tubes()) part.tubes.resize(part.grid.size());
  return part;
}

void CellPosts::build_parts(std::int64_t cell) {
  const ProblemSpec& spec = file_->results.spec();
  file_->parts.clear();
  file_->place.clear();
  for (std::size_t i = 0; i < grid_->size(); ++i) {
    Abstraction& part = file_->parts.emplace_back(part_of(i, cell));
    const bool is_affine = build_affine_table(spec, file_->dynamics, part, i, file_->team).has_value();
    if (!is_affine) build_enclosure_tables(spec, file_->dynamics, part, {i}, file_->team);
    std::int64_t place = 0;
    for (std::size_t j = 0; j < part.grid.size(); ++j) {
      if (part.grid[j].count > 1) place += grid_->index(cell, j) * part.grid.stride(j);
    }
    file_->place.push_back(place);
    file_->entries_built += static_cast<double>(part.tables[i].entries.size());
  }
}

ResolvedRange CellPosts::resolved(std::size_t i, std::int64_t u) const {
  return whole_ ? whole_->resolved(i, cell_, u) : file_->parts[i].resolved(i, file_->place[i], u);
}

ResolvedRange CellPosts::resolved_tube(std::size_t i, std::int64_t u) const {
  return whole_ ? whole_->resolved_tube(i, cell_, u) : file_->parts[i].resolved_tube(i, file_->place[i], u);
}

IndexRange CellPosts::raw_tube(std::size_t i, std::int64_t u) const {
  return whole_ ? whole_->raw_tube(i, cell_, u) : file_->parts[i].raw_tube(i, file_->place[i], u);
}

}  // namespace coordreq
