#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "spec/check_limits.hpp"
#include "spec/spec_errors.hpp"
#include "spec/spec_parts.hpp"
#include "spec/system_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;

constexpr std::array<std::pair<std::string_view, Outside>, 6> kOutside{{{"unsafe", Outside::unsafe},
                                                                        {"safe", Outside::safe},
                                                                        {"saturate", Outside::saturate},
                                                                        {"stop", Outside::stop},
                                                                        {"periodic", Outside::periodic},
                                                                        {"goal", Outside::goal}}};

Outside read_side(const Node& node, Time time, bool has_goal) {
  const auto* const entry = std::find_if(kOutside.begin(), kOutside.end(),
                                         [&](const auto& one) { return one.first == node.text(); });
  if (entry->second == Outside::stop && time == Time::discrete) {
    throw SpecError("'stop' is for continuous time, expected 'saturate' or another", node.pointer());
  }
  if (entry->second == Outside::goal && !has_goal)
    throw SpecError("'goal' is for a spec with the key 'goal', expected 'safe' or another", node.pointer());
  return entry->second;
}

void read_outside(const Node& object, Time time, bool has_goal, StateSpec& state) {
  if (!object.has("outside")) return;
  const Node outside = object["outside"];
  if (outside.is_text()) {
    state.below = state.above = read_side(outside, time, has_goal);
    return;
  }
  if (outside.has("below")) state.below = read_side(outside["below"], time, has_goal);
  if (outside.has("above")) state.above = read_side(outside["above"], time, has_goal);
  if ((state.below == Outside::periodic) != (state.above == Outside::periodic)) {
    throw SpecError("expected 'periodic' on both sides, found it on one", outside.pointer());
  }
}

StateSpec read_state(const Scope& scope, const Node& object, Time time, bool has_goal) {
  StateSpec state;
  state.name = object["name"].text();
  state.unit = read_unit(object);
  read_outside(object, time, has_goal, state);
  state.discrete = object.flag("discrete");
  GridReading reading = read_grid(scope, object,
                                  state.below == Outside::periodic ? GridOf::periodic_cells
                                  : state.discrete                 ? GridOf::points
                                                                   : GridOf::cells);
  state.grid = std::move(reading.grid);
  state.lower = std::move(reading.lower);
  state.upper = std::move(reading.upper);
  if (object.has("measurement_error")) {
    const Node error = object["measurement_error"];
    state.measurement_error = scope.number(error);
    if (state.measurement_error < 0) {
      throw SpecError("expected an error >= 0, found " + to_text(state.measurement_error), error.pointer());
    }
    if (state.discrete && state.measurement_error != 0) {
      throw SpecError("a discrete state cannot have a measurement error", error.pointer());
    }
  }
  return state;
}

std::vector<Rational> listed_values(const Scope& scope, const Node& list) {
  std::vector<Rational> values;
  std::map<Rational, std::size_t> first_at;
  for (const Node& node : list.elements()) {
    values.push_back(scope.number(node));
    const auto [entry, is_new] = first_at.try_emplace(values.back(), values.size() - 1);
    if (!is_new) {
      throw SpecError(
          fmt::format("repeated value {}, the same as number {}", to_text(values.back()), entry->second),
          node.pointer());
    }
  }
  return values;
}

std::vector<Rational> grid_values(const GridSpec& grid) {
  std::vector<Rational> values;
  values.reserve(static_cast<std::size_t>(grid.count));
  Rational value = grid.first;
  for (std::int64_t i = 0; i < grid.count; ++i, value += grid.step) values.push_back(value);
  return values;
}

/// Everything but the values of a grid, which may be too many.
InputSpec read_input(const Scope& scope, const Node& object) {
  InputSpec input;
  input.name = object["name"].text();
  input.unit = read_unit(object);
  if (object.has("values")) {
    input.values = listed_values(scope, object["values"]);
  } else {
    input.grid = read_grid(scope, object, GridOf::points).grid;
    check_value_count(input.grid->count, object.pointer());
    check_value_bits(*input.grid, object.pointer());
  }
  return input;
}

}  // namespace

std::vector<StateSpec> read_states(const Scope& scope, const Node& root) {
  const Time time = read_time(root);
  std::vector<StateSpec> states;
  ErrorList errors;
  for (const Node& object : root.elements("states"))
    errors.attempt([&] { states.push_back(read_state(scope, object, time, root.has("goal"))); });
  errors.raise();
  check_cell_count(states);
  return states;
}

std::vector<InputSpec> read_inputs(const Scope& scope, const Node& root) {
  std::vector<InputSpec> inputs;
  ErrorList errors;
  for (const Node& object : root.elements("inputs"))
    errors.attempt([&] { inputs.push_back(read_input(scope, object)); });
  errors.raise();
  std::vector<std::int64_t> counts;
  for (const InputSpec& input : inputs)
    counts.push_back(input.grid ? input.grid->count : static_cast<std::int64_t>(input.values.size()));
  check_joint_input_count(counts);
  for (InputSpec& input : inputs) {
    if (input.grid) input.values = grid_values(*input.grid);
  }
  return inputs;
}

std::vector<DisturbanceSpec> read_disturbances(const Scope& scope, const Node& root) {
  std::vector<DisturbanceSpec> disturbances;
  for (const Node& object : root.elements("disturbances")) {
    DisturbanceSpec disturbance{object["name"].text(), read_unit(object), scope.number(object["lower"]),
                                scope.number(object["upper"])};
    if (disturbance.upper < disturbance.lower) {
      throw SpecError(fmt::format("expected upper >= lower = {}, found {}", to_text(disturbance.lower),
                                  to_text(disturbance.upper)),
                      object["upper"].pointer());
    }
    disturbances.push_back(std::move(disturbance));
  }
  return disturbances;
}

}  // namespace coordreq
