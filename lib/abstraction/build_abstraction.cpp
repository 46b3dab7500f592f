#include "abstraction/build_abstraction.hpp"

#include <algorithm>
#include <optional>

#include "abstraction/affine_table.hpp"
#include "abstraction/cells_meeting.hpp"
#include "abstraction/counter.hpp"
#include "abstraction/enclosure_table.hpp"
#include "dynamics/affine_dynamics.hpp"

namespace coordreq {
namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

/// What saturates is at the last (first) grid point when it is measured, however far out the post lies; an
/// error of half a cell or more then shows it in another cell than the boundary one.
void include_measurements_of_saturated(const GridDimension& dimension, Cells cells, TransitionTable& table) {
  const Rational& error = dimension.measurement_error;
  if (error == 0) return;
  if (dimension.above == Outside::saturate) {
    const Rational last = dimension.point(dimension.count - 1);
    const IndexRange seen = cells_meeting(dimension, cells, last - error, last, true);
    for (IndexRange& entry : table.entries) entry.first = std::min(entry.first, seen.first);
  }
  if (dimension.below == Outside::saturate) {
    const IndexRange seen = cells_meeting(dimension, cells, dimension.first, dimension.first + error, true);
    for (IndexRange& entry : table.entries) entry.last = std::max(entry.last, seen.last);
  }
}

}  // namespace

std::vector<TableShape> table_shapes(const ProblemSpec& spec) {
  const AffineDynamics dynamics(spec);
  std::vector<TableShape> shapes;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const Dependencies& dependencies = dynamics.dependencies(i);
    TableShape shape{.states = dependencies.moving,
                     .inputs = dependencies.inputs,
                     .disturbances = dependencies.disturbances};
    shape.states.insert(shape.states.end(), dependencies.parameters.begin(), dependencies.parameters.end());
    std::sort(shape.states.begin(), shape.states.end());
    for (const std::int32_t j : shape.states) {
      shape.entries *= static_cast<double>(spec.states[static_cast<std::size_t>(j)].grid.count);
    }
    for (const std::int32_t j : shape.inputs) {
      shape.entries *= static_cast<double>(spec.inputs[static_cast<std::size_t>(j)].values.size());
    }
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

bool check_dynamics(const ProblemSpec& spec) {
  const AffineDynamics dynamics(spec);
  bool exact = true;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const Dependencies& dependencies = dynamics.dependencies(i);
    std::vector<std::int64_t> counts;
    for (const std::int32_t j : dependencies.parameters) counts.push_back(spec.states[at(j)].grid.count);
    for (const std::int32_t j : dependencies.inputs) {
      counts.push_back(static_cast<std::int64_t>(spec.inputs[at(j)].values.size()));
    }
    Counter choice(counts);
    do {
      std::vector<Rational> slots(spec.slot_count());
      std::size_t position = 0;
      for (const std::int32_t j : dependencies.parameters) {
        const GridSpec& grid = spec.states[at(j)].grid;
        slots[spec.state_slot(at(j))] =
            grid.first + grid.step * Rational(static_cast<long>(choice.indices()[position++]));
      }
      for (const std::int32_t j : dependencies.inputs) {
        slots[spec.input_slot(at(j))] =
            spec.inputs[at(j)].values[static_cast<std::size_t>(choice.indices()[position++])];
      }
      const std::optional<SampledRow> row = dynamics.row(i, slots);
      exact = exact && row && row->exact;
    } while (choice.next());
  }
  return exact;
}

Abstraction build_abstraction(const ProblemSpec& spec, ThreadTeam& team) {
  const AffineDynamics dynamics(spec);
  Abstraction abstraction{.grid = make_grid(spec), .inputs = make_input_space(spec)};
  abstraction.tables.resize(spec.states.size());
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const std::optional<bool> exact = build_affine_table(spec, dynamics, abstraction, i, team);
    if (!exact) build_enclosure_table(spec, dynamics.dependencies(i), abstraction, i, team);
    abstraction.exact = abstraction.exact && exact.value_or(false);
    include_measurements_of_saturated(abstraction.grid[i], spec.abstraction.cells, abstraction.tables[i]);
  }
  return abstraction;
}

}  // namespace coordreq
