#include "abstraction/build_abstraction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "abstraction/affine_table.hpp"
#include "abstraction/counter.hpp"
#include "abstraction/enclosure_table.hpp"
#include "base/error.hpp"
#include "dynamics/affine_dynamics.hpp"
#include "dynamics/shift.hpp"

namespace coordreq {
namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

/// Between its values a discrete state has no cells.
void check_between_samples(const ProblemSpec& spec, const AffineDynamics& dynamics) {
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const std::vector<std::int32_t>& constant = dynamics.dependencies(i).parameters;
    const bool moves =
        std::find(constant.begin(), constant.end(), static_cast<std::int32_t>(i)) == constant.end();
    if (!spec.states[i].discrete || !moves) continue;
    throw SpecError(fmt::format("the discrete state '{}' moves between the samples, where it has no cells, "
                                "expected the equation 0 with 'between_samples'",
                                spec.states[i].name),
                    "/dynamics/equations/" + spec.states[i].name);
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
                     .disturbances = dependencies.disturbances,
                     .shift = is_shift(spec, dependencies, i)};
    shape.states.insert(shape.states.end(), dependencies.parameters.begin(), dependencies.parameters.end());
    std::sort(shape.states.begin(), shape.states.end());
    for (const std::int32_t j : shape.states) {
      if (shape.shift && at(j) == i) continue;
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
  if (spec.abstraction.between_samples) check_between_samples(spec, dynamics);
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
  if (spec.abstraction.between_samples) {
    check_between_samples(spec, dynamics);
    abstraction.tubes.resize(spec.states.size());
  }
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const std::optional<bool> exact = build_affine_table(spec, dynamics, abstraction, i, team);
    if (!exact) build_enclosure_table(spec, dynamics.dependencies(i), abstraction, i, team);
    abstraction.exact = abstraction.exact && exact.value_or(false);
  }
  return abstraction;
}

}  // namespace coordreq
