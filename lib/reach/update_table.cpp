#include "reach/tables.hpp"

#include <memory>
#include <optional>
#include <vector>

#include "base/index.hpp"
#include "base/requires.hpp"
#include "model/odometer.hpp"
#include "model/table_shape.hpp"
#include "ranks/divided_loop.hpp"
#include "reach/divided_entries.hpp"
#include "reach/update_ranges.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

[[maybe_unused]] bool is_in_order_of_spec(const UniformGrid& grid) {
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (grid.state(i) != i) return false;
  }
  return true;
}

}  // namespace

void build_update_table(const SystemSpec& spec, Abstraction& abstraction, std::size_t state, ThreadTeam& team,
                        Ranks* ranks) {
  REQUIRES(is_in_order_of_spec(abstraction.grid));
  const Dependencies dependencies = find_dependencies(spec, state);
  const UniformGrid& grid = abstraction.grid;
  const InputSpace& inputs = abstraction.inputs;
  TransitionTable& table = abstraction.tables[state];
  table = full_layout(spec, dependencies, state, abstraction);
  TransitionTable* const tube = abstraction.tubes.empty() ? nullptr : &abstraction.tubes[state];
  if (tube != nullptr) *tube = table;
  std::vector<std::uint32_t> slots;  // points first: they are read outside of conditions
  std::vector<std::int64_t> strides;
  std::vector<std::int64_t> counts;
  const auto add = [&](std::uint32_t slot, std::int64_t stride, std::int64_t count) {
    slots.push_back(slot);
    strides.push_back(stride);
    counts.push_back(count);
  };
  const auto add_states = [&](bool discrete) {
    for (const std::int32_t j : dependencies.all_states()) {
      if (grid[at(j)].discrete == discrete)
        add(spec.state_slot(at(j)), table.state_stride[at(j)], grid[at(j)].count);
    }
  };
  add_states(true);
  for (const std::int32_t j : dependencies.inputs)
    add(spec.input_slot(at(j)), table.input_stride[at(j)], inputs[at(j)].count());
  const Odometer points(counts);
  const std::size_t first_box = counts.size();
  add_states(false);
  const Odometer boxes({counts.begin() + static_cast<std::ptrdiff_t>(first_box), counts.end()});
  const std::int64_t boxes_of_point = boxes.size();
  const ThreadTeam::Range local_points = divided_range(ranks, points.size());
  const ThreadTeam::Range local{local_points.begin * boxes_of_point, local_points.end * boxes_of_point};
  DividedEntries entries(table, {counts, strides}, local, ranks);
  std::optional<DividedEntries> tube_entries;
  if (tube != nullptr) tube_entries.emplace(*tube, DividedEntries::Positions{counts, strides}, local, ranks);
  std::vector<std::unique_ptr<UpdateRanges>> scratch(static_cast<std::size_t>(team.size()));
  for_each_divided(ranks, team, points.size(), 1, [&](ThreadTeam::Range range, int worker) {
    std::unique_ptr<UpdateRanges>& ranges = scratch[static_cast<std::size_t>(worker)];
    if (!ranges) ranges = std::make_unique<UpdateRanges>(spec, grid, inputs, state);
    std::vector<std::int64_t> indices(spec.slot_count(), 0);
    Odometer point = points;
    point.seek(range.begin);
    for (std::int64_t i = range.begin; i < range.end; ++i, point.advance()) {
      std::int64_t base = 0;
      for (std::size_t v = 0; v < first_box; ++v) {
        indices[slots[v]] = point[v];
        base += point[v] * strides[v];
      }
      Odometer box = boxes;
      std::int64_t choice = i * boxes_of_point;
      bool is_new = true;
      do {
        std::int64_t position = base;
        for (std::size_t v = first_box; v < slots.size(); ++v) {
          indices[slots[v]] = box[v - first_box];
          position += box[v - first_box] * strides[v];
        }
        entries.at(choice, position) = ranges->at(indices, is_new);
        is_new = false;
        const auto present = static_cast<std::int32_t>(indices[spec.state_slot(state)]);
        if (tube_entries) tube_entries->at(choice, position) = {present, present};
        ++choice;
      } while (box.advance());
    }
  });
  entries.join();
  if (tube_entries) tube_entries->join();
}

}  // namespace coordreq
