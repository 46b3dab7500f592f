#include "reach/build_abstraction.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "reach/affine_dynamics.hpp"
#include "reach/cells_meeting.hpp"
#include "reach/shift.hpp"
#include "reach/table_shapes.hpp"
#include "reach/tables.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

/// Some seconds of work.
constexpr double kMostCheckedEntries = 1e7;

/// Lists of states with the same dependencies, so that one flow serves them all; in discrete time of one
/// each.
std::vector<std::vector<std::size_t>> group_by_flow(const SystemSpec& spec,
                                                    const std::vector<TableShape>& shapes,
                                                    const std::vector<std::size_t>& states) {
  const auto share = [&](const Dependencies& a, const Dependencies& b) {
    return spec.dynamics.time == Time::continuous && a == b;
  };
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t i : states) {
    const auto group = std::find_if(groups.begin(), groups.end(),
                                    [&](const auto& one) { return share(shapes[one.front()], shapes[i]); });
    if (group == groups.end()) {
      groups.push_back({i});
    } else {
      group->push_back(i);
    }
  }
  return groups;
}

void build_in_full(const SystemSpec& spec, const std::vector<TableShape>& shapes, Abstraction& abstraction,
                   const std::vector<std::size_t>& states, ThreadTeam& team, Ranks* ranks) {
  const AffineDynamics dynamics(spec);
  std::vector<std::size_t> others;
  for (const std::size_t i : states) {
    abstraction.tables[i] = {};
    if (spec.dynamics.update(i) != nullptr) {
      build_update_table(spec, abstraction, i, team, ranks);
      continue;
    }
    const std::optional<bool> exact = build_affine_table(spec, dynamics, abstraction, i, team);
    abstraction.exact = abstraction.exact && exact.value_or(false);
    if (!exact) others.push_back(i);
  }
  for (const std::vector<std::size_t>& group : group_by_flow(spec, shapes, others)) {
    build_enclosure_tables(spec, dynamics, abstraction, group, team, {}, ranks);
  }
}

}  // namespace

Abstraction build_abstraction(const SystemSpec& spec, const std::vector<TableShape>& shapes, ThreadTeam& team,
                              std::optional<HeldCells> held, Ranks* ranks) {
  Abstraction abstraction{.grid = make_grid(spec), .inputs = make_input_space(spec), .held = std::move(held)};
  abstraction.tables.resize(spec.states.size());
  if (spec.abstraction.between_samples) {
    check_between_samples(spec);
    abstraction.tubes.resize(spec.states.size());
  }
  std::vector<std::size_t> sums;
  std::vector<std::size_t> full;
  for (std::size_t i = 0; i < spec.states.size(); ++i) (shapes[i].sum ? sums : full).push_back(i);
  for (const std::vector<std::size_t>& states : group_by_flow(spec, shapes, sums)) {
    if (build_sum_tables(spec, shapes, abstraction, states, team, ranks)) {
      abstraction.exact = false;
    } else {
      full.insert(full.end(), states.begin(), states.end());
    }
  }
  std::sort(full.begin(), full.end());
  build_in_full(spec, shapes, abstraction, full, team, ranks);
  for (std::size_t i = 0; i < spec.states.size(); ++i)
    include_measurements_of_saturated(spec, abstraction, i);
  return abstraction;
}

void check_discrete_states(const SystemSpec& spec, const std::vector<TableShape>& shapes, ThreadTeam& team) {
  for (std::size_t i = 0; i < spec.states.size(); ++i) {
    if (!spec.states[i].discrete || shapes[i].entries > kMostCheckedEntries) continue;
    Abstraction alone{.grid = make_grid(spec), .inputs = make_input_space(spec)};
    alone.tables.resize(spec.states.size());
    build_in_full(spec, shapes, alone, {i}, team, nullptr);
  }
}

Abstraction build_abstraction(const SystemSpec& spec, ThreadTeam& team) {
  return build_abstraction(spec, table_shapes(spec), team);
}

void include_measurements_of_saturated(const SystemSpec& spec, Abstraction& abstraction, std::size_t state) {
  if (!has_measured_limit(spec.states[state])) return;
  const GridDimension& dimension = abstraction.grid[state];
  const Rational& error = dimension.measurement_error;
  const Cells cells = spec.abstraction.cells;
  std::vector<IndexRange>& entries = abstraction.tables[state].entries;
  if (dimension.above == Outside::saturate) {
    const Rational last = dimension.point(dimension.count - 1);
    const IndexRange seen = cells_meeting(dimension, cells, last - error, last, true);
    for (IndexRange& entry : entries) entry.first = std::min(entry.first, seen.first);
  }
  if (dimension.below == Outside::saturate) {
    const IndexRange seen = cells_meeting(dimension, cells, dimension.first, dimension.first + error, true);
    for (IndexRange& entry : entries) entry.last = std::max(entry.last, seen.last);
  }
}

}  // namespace coordreq
