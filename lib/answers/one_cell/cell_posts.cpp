#include "answers/one_cell/cell_posts.hpp"

#include <algorithm>
#include <utility>

#include "answers/one_cell/cell_members.hpp"
#include "base/index.hpp"
#include "base/requires.hpp"
#include "reach/build_abstraction.hpp"
#include "reach/table_shapes.hpp"
#include "reach/tables.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

/// The number of entries computed one by one after which the whole is computed. 0 if a table is a sum: sums
/// have few entries, and entries of other tables would be other ranges.
double most_entries(const std::vector<TableShape>& shapes) {
  const bool sums = std::any_of(shapes.begin(), shapes.end(), [](const TableShape& one) { return one.sum; });
  return sums ? 0 : entries_of(shapes);
}

/// Adds the unsafe sides that a range passes.
void add_sides(std::size_t i, IndexRange raw, const GridDimension& dimension, CellPost& post) {
  const bool below = raw.first < 0 && traits(dimension.below).blocks;
  const bool above = raw.last >= dimension.count && traits(dimension.above).blocks;
  if (below) post.sides.push_back({.dimension = i, .above = false});
  if (above) post.sides.push_back({.dimension = i, .above = true});
  if (below || above) post.blocked = CellPost::Blocked::left_domain;
}

}  // namespace

CellPosts::CellPosts(const SystemSpec& spec, const UniformGrid& grid, const InputSpace& inputs,
                     ThreadTeam& team, std::optional<Abstraction> stored)
    : grid_(&grid), inputs_(&inputs) {
  const std::vector<TableShape> shapes = table_shapes(spec);
  source_ = std::make_unique<Source>(Source{spec,
                                            team,
                                            AffineDynamics(spec),
                                            entries_of(shapes),
                                            most_entries(shapes),
                                            {},
                                            {},
                                            0,
                                            std::move(stored)});
  if (source_->whole) whole_ = &*source_->whole;
}

const Abstraction& CellPosts::whole() {
  if (whole_ == nullptr) {
    source_->whole = build_abstraction(source_->spec, source_->team);
    source_->entries_built += source_->all_entries;
    whole_ = &*source_->whole;
  }
  return *whole_;
}

const std::vector<std::int32_t>& CellPosts::inputs_of(std::size_t i) const {
  return source_ ? source_->dynamics.dependencies(i).inputs : whole_->tables[i].inputs;
}

std::int64_t CellPosts::entries_built() const {
  return source_ ? static_cast<std::int64_t>(source_->entries_built) : 0;
}

bool CellPosts::has_tubes() const {
  return source_ ? source_->spec.abstraction.between_samples : !whole_->tubes.empty();
}

void CellPosts::move_to(std::int64_t cell) {
  if (cell == cell_) return;
  if (whole_ == nullptr && source_->entries_built >= source_->most_entries) prepare_all();
  if (whole_ == nullptr) build_by_state(cell);
  cell_ = cell;
}

/// Restricts the states in which the map moves: a table is then filled for their one index. The dimension of
/// the state itself stays whole, because it is also the one that posts lie in (and may be periodic), and so
/// do discrete states whose values are put in one by one: whether the system is affine is decided over all of
/// them, and must be decided as in the analysis. A state that stops stays whole, because its limits are the
/// first and the last point of its dimension.
Abstraction CellPosts::abstraction_of(std::size_t state, std::int64_t cell) const {
  std::vector<GridDimension> dimensions = grid_->dimensions();
  for (std::size_t j = 0; j < dimensions.size(); ++j) {
    const bool stops = traits(dimensions[j].below).stops || traits(dimensions[j].above).stops;
    if (j == state || stops || !contains(source_->dynamics.dependencies(state).moving, j)) continue;
    dimensions[j].first = dimensions[j].point(grid_->index(cell, j));
    dimensions[j].count = 1;
  }
  Abstraction abstraction{.grid = UniformGrid(std::move(dimensions)), .inputs = *inputs_};
  abstraction.tables.resize(abstraction.grid.size());
  if (has_tubes()) abstraction.tubes.resize(abstraction.grid.size());
  return abstraction;
}

void CellPosts::build_by_state(std::int64_t cell) {
  const SystemSpec& spec = source_->spec;
  source_->by_state.clear();
  source_->position.clear();
  for (std::size_t i = 0; i < grid_->size(); ++i) {
    Abstraction& abstraction = source_->by_state.emplace_back(abstraction_of(i, cell));
    const bool jumps = spec.dynamics.update(i) != nullptr;
    if (jumps) build_update_table(spec, abstraction, i, source_->team);
    const bool is_affine =
        jumps || build_affine_table(spec, source_->dynamics, abstraction, i, source_->team).has_value();
    const std::int64_t index = grid_->index(cell, i);
    if (!is_affine) build_enclosure_tables(spec, source_->dynamics, abstraction, {i}, source_->team, index);
    auto entries = static_cast<double>(abstraction.tables[i].entries.size());
    if (!is_affine && abstraction.tables[i].state_stride[i] != 0)
      entries /= static_cast<double>((*grid_)[i].count);
    include_measurements_of_saturated(spec, abstraction, i);
    std::int64_t position = 0;
    for (std::size_t j = 0; j < abstraction.grid.size(); ++j) {
      if (abstraction.grid[j].count > 1) position += grid_->index(cell, j) * abstraction.grid.stride(j);
    }
    source_->position.push_back(position);
    source_->entries_built += entries;
  }
}

ResolvedRange CellPosts::resolved(std::size_t i, std::int64_t u) const {
  return whole_ ? whole_->resolved(i, cell_, u) : source_->by_state[i].resolved(i, source_->position[i], u);
}

ResolvedRange CellPosts::resolved_tube(std::size_t i, std::int64_t u) const {
  REQUIRES(has_tubes());
  return whole_ ? whole_->resolved_tube(i, cell_, u)
                : source_->by_state[i].resolved_tube(i, source_->position[i], u);
}

IndexRange CellPosts::raw_tube(std::size_t i, std::int64_t u) const {
  REQUIRES(has_tubes());
  return whole_ ? whole_->raw_tube(i, cell_, u) : source_->by_state[i].raw_tube(i, source_->position[i], u);
}

IndexRange CellPosts::raw(std::size_t i, std::int64_t u) const {
  return whole_ ? whole_->raw(i, cell_, u) : source_->by_state[i].raw(i, source_->position[i], u);
}

CellPost CellPosts::post(std::int64_t u, const TubeSets& tubes) const {
  CellPost post;
  for (std::size_t i = 0; i < grid_->size(); ++i) {
    add_sides(i, raw(i, u), (*grid_)[i], post);
    const IndexRange inside = resolved(i, u).inside;
    post.all_left = post.all_left || inside.first > inside.last;
    post.box.push_back(inside);
  }
  if (post.blocked == CellPost::Blocked::no && tubes.inside != nullptr) follow_tube(u, tubes, post);
  return post;
}

void CellPosts::follow_tube(std::int64_t u, const TubeSets& tubes, CellPost& post) const {
  std::vector<IndexRange> tube;
  bool passes = false;
  bool all_left = false;
  for (std::size_t i = 0; i < grid_->size(); ++i) {
    const IndexRange range = raw_tube(i, u);
    const ResolvedRange inside = resolved_tube(i, u);
    add_sides(i, range, (*grid_)[i], post);
    passes = passes || passes_a_limit(range, (*grid_)[i]);
    all_left = all_left || inside.all_left();
    tube.push_back(inside.inside);
  }
  if (post.blocked != CellPost::Blocked::no || all_left) return;
  const CellSet& safe = passes && tubes.beyond != nullptr ? *tubes.beyond : *tubes.inside;
  if (!for_each_cell(*grid_, tube, [&safe](std::int64_t cell) { return safe.test(cell); }))
    post.blocked = CellPost::Blocked::unsafe_between_samples;
}

}  // namespace coordreq
