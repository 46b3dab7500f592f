#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "answers/requirements/result_requirement.hpp"
#include "base/index.hpp"
#include "model/locate.hpp"
#include "model/sample_reset.hpp"
#include "reach/abstraction.hpp"
#include "reach/point_dynamics.hpp"
#include "spec/problem_spec.hpp"

// The system itself beside a counterexample, one step after the other.
namespace coordreq {

/// Where it is after a step, with every disturbance in the middle of its range; nothing: in no cell.
inline std::optional<std::int64_t> real_step(const ProblemSpec& spec, const Abstraction& a,
                                             PointDynamics& dynamics, std::vector<Rational>& state,
                                             std::int64_t u) {
  std::vector<Rational> slots(spec.slot_count());
  for (std::size_t i = 0; i < state.size(); ++i) slots[spec.state_slot(i)] = state[i];
  for (std::size_t l = 0; l < spec.disturbances.size(); ++l)
    slots[spec.disturbance_slot(l)] = (spec.disturbances[l].lower + spec.disturbances[l].upper) / 2;
  for (std::size_t i = 0; i < a.inputs.size(); ++i)
    slots[spec.input_slot(i)] = a.inputs[i].values[at(a.inputs.index(u, i))];
  for (std::size_t i = 0; i < state.size(); ++i)
    state[i] = reset_at_sample(a.grid[i], dynamics.next(i, slots).value());
  const Location location = locate(a.grid, state);
  return location.kind == Location::Kind::cell ? std::optional(location.cell) : std::nullopt;
}

/// While a story is what the system itself does it goes on so, if that is as bad as it gets.
/// @param input of a step @param value of a cell after a step: how bad it is
inline void expect_followed(const ProblemSpec& spec, const Abstraction& a, const ResultPath& path,
                            const std::function<std::int64_t(std::size_t step)>& input,
                            const std::function<std::int32_t(std::size_t step, std::int64_t cell)>& value) {
  PointDynamics dynamics(spec);
  std::vector<Rational> state;
  const auto first = static_cast<std::int64_t>(path.cell.front());
  for (std::size_t i = 0; i < a.grid.size(); ++i) state.push_back(a.grid[i].point(a.grid.index(first, i)));
  std::size_t followed = 0;
  for (; followed + 1 < path.samples(); ++followed) {
    const std::optional<std::int64_t> real = real_step(spec, a, dynamics, state, input(followed));
    const auto next = static_cast<std::int64_t>(path.cell[followed + 1]);
    if (!real || value(followed, *real) != value(followed, next)) break;
    RC_ASSERT(*real == next);
  }
  RC_CLASSIFY(followed + 1 == path.samples(), "the system itself goes all the way");
}

}  // namespace coordreq
