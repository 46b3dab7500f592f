#include "reach/build_abstraction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/error.hpp"
#include "reach/affine_dynamics.hpp"
#include "reach/affine_table.hpp"
#include "reach/cells_meeting.hpp"
#include "reach/counter.hpp"
#include "reach/enclosure_table.hpp"
#include "reach/shift.hpp"
#include "reach/sum_table.hpp"

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

bool contains(const std::vector<std::int32_t>& list, std::int32_t value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

/// Calls `visit` with the exact row of a state for each choice of its parameters and inputs, until it returns
/// false.
template <class Visit>
void for_each_row(const ProblemSpec& spec, const AffineDynamics& dynamics, std::size_t state, Limits limits,
                  const Visit& visit) {
  const Dependencies& dependencies = dynamics.dependencies(state);
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
    if (!visit(dynamics.row(state, slots, limits))) return;
  } while (choice.next());
}

/// The states that get terms if the table of `state` is a sum; empty if it is to be none. With tubes there
/// are no sums: a tube is an entry for every choice in any case, found by the same flow as that of the table.
std::vector<std::int32_t> states_of_sum(const ProblemSpec& spec, const AffineDynamics& dynamics,
                                        const AffinePart& part, std::size_t state) {
  if (spec.abstraction.between_samples || has_measured_limit(spec.states[state])) return {};
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
void measure(const ProblemSpec& spec, const AffineDynamics& dynamics, std::size_t state, TableShape& shape) {
  const AffinePart part = find_affine_part(spec, dynamics.dependencies(state), state);
  const std::vector<std::int32_t> summed = states_of_sum(spec, dynamics, part, state);
  shape.sum = !summed.empty();
  const auto count = [&](std::int32_t j) { return static_cast<double>(spec.states[at(j)].grid.count); };
  const auto values = [&](std::int32_t j) { return static_cast<double>(spec.inputs[at(j)].values.size()); };
  for (const std::int32_t j : shape.states) {
    const bool left_out = (shape.shift && at(j) == state) || contains(summed, j);
    if (!left_out) shape.entries *= count(j);
  }
  for (const std::int32_t j : shape.inputs) shape.entries *= values(j);
  for (const std::int32_t term : summed) {
    double size = count(term);
    for (const std::int32_t j : part.parameters) size *= count(j);
    for (const std::int32_t j : part.inputs) size *= values(j);
    shape.entries += size;
  }
  shape.bytes =
      shape.entries * static_cast<double>(shape.sum ? 2 * sizeof(std::int64_t) : sizeof(IndexRange));
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
                     .disturbances = dependencies.disturbances,
                     .shift = is_shift(spec, dependencies, i)};
    shape.states.insert(shape.states.end(), dependencies.parameters.begin(), dependencies.parameters.end());
    std::sort(shape.states.begin(), shape.states.end());
    measure(spec, dynamics, i, shape);
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

bool check_dynamics(const ProblemSpec& spec) {
  const AffineDynamics dynamics(spec);
  if (spec.abstraction.between_samples) check_between_samples(spec, dynamics);
  bool exact = true;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    for_each_row(spec, dynamics, i, Limits::obeyed, [&](const std::optional<SampledRow>& row) {
      exact = exact && row && row->exact;
      return true;
    });
  }
  return exact;
}

namespace {

/// Lists of states with the same dependencies, so that one flow serves them all; in discrete time of one
/// each.
std::vector<std::vector<std::size_t>> group_by_flow(const ProblemSpec& spec, const AffineDynamics& dynamics,
                                                    const std::vector<std::size_t>& states) {
  const auto share = [&](std::size_t i, std::size_t j) {
    return spec.dynamics.time == Time::continuous && dynamics.dependencies(i) == dynamics.dependencies(j);
  };
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t i : states) {
    const auto group =
        std::find_if(groups.begin(), groups.end(), [&](const auto& one) { return share(one.front(), i); });
    if (group == groups.end()) {
      groups.push_back({i});
    } else {
      group->push_back(i);
    }
  }
  return groups;
}

bool build_sums(const ProblemSpec& spec, const AffineDynamics& dynamics, Abstraction& abstraction,
                const std::vector<std::size_t>& states, ThreadTeam& team) {
  const Dependencies& dependencies = dynamics.dependencies(states.front());
  return build_sum_tables(spec, dependencies, find_affine_part(spec, dependencies, states.front()),
                          abstraction, states, team);
}

void build_in_full(const ProblemSpec& spec, const AffineDynamics& dynamics, Abstraction& abstraction,
                   const std::vector<std::size_t>& states, ThreadTeam& team) {
  std::vector<std::size_t> others;
  for (const std::size_t i : states) {
    abstraction.tables[i] = {};
    const std::optional<bool> exact = build_affine_table(spec, dynamics, abstraction, i, team);
    abstraction.exact = abstraction.exact && exact.value_or(false);
    if (!exact) others.push_back(i);
  }
  for (const std::vector<std::size_t>& group : group_by_flow(spec, dynamics, others)) {
    build_enclosure_tables(spec, dynamics, abstraction, group, team);
  }
}

}  // namespace

Abstraction build_abstraction(const ProblemSpec& spec, ThreadTeam& team) {
  const AffineDynamics dynamics(spec);
  Abstraction abstraction{.grid = make_grid(spec), .inputs = make_input_space(spec)};
  abstraction.tables.resize(spec.states.size());
  if (spec.abstraction.between_samples) {
    check_between_samples(spec, dynamics);
    abstraction.tubes.resize(spec.states.size());
  }
  std::vector<std::size_t> sums;
  std::vector<std::size_t> full;
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    const AffinePart part = find_affine_part(spec, dynamics.dependencies(i), i);
    (states_of_sum(spec, dynamics, part, i).empty() ? full : sums).push_back(i);
  }
  for (const std::vector<std::size_t>& states : group_by_flow(spec, dynamics, sums)) {
    if (build_sums(spec, dynamics, abstraction, states, team)) {
      abstraction.exact = false;
    } else {
      full.insert(full.end(), states.begin(), states.end());
    }
  }
  std::sort(full.begin(), full.end());
  build_in_full(spec, dynamics, abstraction, full, team);
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (!has_measured_limit(spec.states[i])) continue;
    include_measurements_of_saturated(abstraction.grid[i], spec.abstraction.cells, abstraction.tables[i]);
  }
  return abstraction;
}

}  // namespace coordreq
