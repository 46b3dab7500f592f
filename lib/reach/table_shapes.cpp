#include "reach/table_shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/error.hpp"
#include "base/fast_paths.hpp"
#include "base/index.hpp"
#include "model/odometer.hpp"
#include "reach/abstraction.hpp"
#include "reach/affine_dynamics.hpp"
#include "reach/shift.hpp"
#include "reach/tables.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

/// Calls `visit` with the exact row of a state for each choice of its parameters and inputs, until it returns
/// false.
template <class Visit>
void for_each_row(const SystemSpec& spec, const AffineDynamics& dynamics, std::size_t state, Limits limits,
                  const Visit& visit) {
  const Dependencies& dependencies = dynamics.dependencies(state);
  std::vector<std::int64_t> counts;
  for (const std::int32_t j : dependencies.parameters) counts.push_back(spec.states[at(j)].grid.count);
  for (const std::int32_t j : dependencies.inputs) {
    counts.push_back(static_cast<std::int64_t>(spec.inputs[at(j)].values.size()));
  }
  Odometer choice(counts);
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
    if (!visit(dynamics.row(state, slots, limits))) return;
  } while (choice.advance());
}

/// The states that get terms if the table of `state` is a sum; empty if it is to be none. With tubes there
/// are no sums: a tube is an entry for every choice in any case, found by the same flow as that of the table.
std::vector<std::int32_t> states_of_sum(const SystemSpec& spec, const AffineDynamics& dynamics,
                                        const AffinePart& part, std::size_t state) {
  if (!fast_paths().sum_tables || spec.abstraction.between_samples || has_measured_limit(spec.states[state]))
    return {};
  std::vector<std::int32_t> summed = summed_states(spec, dynamics.dependencies(state), part, state);
  if (summed.empty()) return summed;
  bool exact = true;  // then the table holds exact hulls, away from limits at least
  for_each_row(spec, dynamics, state, Limits::ignored, [&](const std::optional<SampledRow>& row) {
    exact = row.has_value();
    return exact;
  });
  return exact ? std::vector<std::int32_t>() : summed;
}

/// Finds out in which form the table will be stored, and how large it gets.
void measure(const SystemSpec& spec, const AffineDynamics& dynamics, std::size_t state, TableShape& shape) {
  const bool jumps = spec.dynamics.update(state) != nullptr;
  const AffinePart part = jumps ? AffinePart() : find_affine_part(spec, shape, state);
  if (!jumps) shape.terms = states_of_sum(spec, dynamics, part, state);
  shape.sum = !shape.terms.empty();
  std::vector<std::int32_t> states = shape.states;
  std::erase_if(states,
                [&](std::int32_t j) { return (shape.shift && at(j) == state) || contains(shape.terms, j); });
  shape.entries = choices_of(spec, states, shape.inputs);
  for (const std::int32_t term : shape.terms)
    shape.entries += choices_of(spec, {term}, {}) * choices_of(spec, part.parameters, part.inputs);
  shape.bytes =
      shape.entries * static_cast<double>(shape.sum ? 2 * sizeof(std::int64_t) : sizeof(IndexRange));
}

}  // namespace

double entries_of(const std::vector<TableShape>& shapes) {
  double entries = 0;
  for (const TableShape& shape : shapes) entries += shape.entries;
  return entries;
}

double choices_of(const SystemSpec& spec, const std::vector<std::int32_t>& states,
                  const std::vector<std::int32_t>& inputs) {
  double choices = 1;
  for (const std::int32_t j : states) choices *= static_cast<double>(spec.states[at(j)].grid.count);
  for (const std::int32_t j : inputs) choices *= static_cast<double>(spec.inputs[at(j)].values.size());
  return choices;
}

std::vector<TableShape> table_shapes(const SystemSpec& spec) {
  const AffineDynamics dynamics(spec);
  std::vector<TableShape> shapes;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    TableShape& shape = shapes.emplace_back(TableShape{dynamics.dependencies(i)});
    shape.states = shape.all_states();
    shape.shift = is_shift(spec, shape, i);
    measure(spec, dynamics, i, shape);
  }
  return shapes;
}

bool check_dynamics(const SystemSpec& spec) {
  const AffineDynamics dynamics(spec);
  if (spec.abstraction.between_samples) check_between_samples(spec);
  bool exact = true;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (spec.dynamics.update(i) != nullptr) continue;
    for_each_row(spec, dynamics, i, Limits::obeyed, [&](const std::optional<SampledRow>& row) {
      exact = exact && row && row->exact;
      return true;
    });
  }
  return exact;
}

void check_between_samples(const SystemSpec& spec) {
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const std::vector<std::int32_t> constant = find_dependencies(spec, i).parameters;
    const bool moves =
        std::find(constant.begin(), constant.end(), static_cast<std::int32_t>(i)) == constant.end();
    if (!spec.states[i].discrete || !moves || spec.dynamics.update(i) != nullptr) continue;
    throw SpecError(fmt::format("the discrete state '{}' moves between the samples, where it has no cells, "
                                "expected the equation 0 with 'between_samples'",
                                spec.states[i].name),
                    "/dynamics/equations/" + spec.states[i].name);
  }
}

}  // namespace coordreq
