#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "answers/requirements/result_requirement.hpp"
#include "base/index.hpp"
#include "model/locate.hpp"
#include "model/sample_reset.hpp"
#include "reach/abstraction.hpp"
#include "reach/point_dynamics.hpp"
#include "spec/problem_spec.hpp"

// Counterexamples step by step, and the system itself beside them.
namespace coordreq {

/// f(x, u) as a list of cells; nothing if it is empty.
inline std::optional<std::vector<std::int64_t>> post_cells(const Abstraction& a, std::int64_t x,
                                                           std::int64_t u) {
  std::vector<std::int64_t> cells = {0};
  for (std::size_t i = 0; i < a.grid.size(); ++i) {
    const ResolvedRange range = a.resolved(i, x, u);
    if (range.blocked) return std::nullopt;
    std::vector<std::int64_t> longer;
    for (const std::int64_t cell : cells) {
      for (std::int64_t k = range.inside.first; k <= range.inside.last; ++k)
        longer.push_back(cell + k % a.grid[i].count * a.grid.stride(i));
    }
    cells = std::move(longer);
  }
  return cells;
}

/// The joint input of a step.
inline std::int64_t input_of(const Abstraction& a, const ResultPath& path, std::size_t step) {
  std::int64_t u = 0;
  for (std::size_t i = 0; i < a.inputs.size(); ++i) {
    const double value = path.input[step * a.inputs.size() + i];
    const auto found = std::find_if(a.inputs[i].values.begin(), a.inputs[i].values.end(),
                                    [&](const Rational& q) { return nearest_double(q) == value; });
    RC_ASSERT(found != a.inputs[i].values.end());
    u += (found - a.inputs[i].values.begin()) * a.inputs.stride(i);
  }
  return u;
}

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
/// @param value of a cell after a step: how bad it is
inline void expect_followed(const ProblemSpec& spec, const Abstraction& a, const ResultPath& path,
                            const std::function<std::int32_t(std::size_t step, std::int64_t cell)>& value) {
  PointDynamics dynamics(spec);
  std::vector<Rational> state;
  const auto first = static_cast<std::int64_t>(path.cell.front());
  for (std::size_t i = 0; i < a.grid.size(); ++i) state.push_back(a.grid[i].point(a.grid.index(first, i)));
  std::size_t followed = 0;
  for (; followed + 1 < path.samples(); ++followed) {
    const std::optional<std::int64_t> real = real_step(spec, a, dynamics, state, input_of(a, path, followed));
    const auto next = static_cast<std::int64_t>(path.cell[followed + 1]);
    if (!real || value(followed, *real) != value(followed, next)) break;
    RC_ASSERT(*real == next);
  }
  RC_CLASSIFY(followed + 1 == path.samples(), "the system itself goes all the way");
}

/// Ways out of K on which each step takes the delay down by one.
struct ShortestWays {
  const std::vector<std::int32_t>& delay;
  std::function<bool(std::int64_t x, std::int64_t u)> is_choice;
};

/// How many steps of them the system itself can follow at the most, but for the last one; all are tried.
inline std::size_t longest_followed(const ProblemSpec& spec, const Abstraction& a, const ShortestWays& ways,
                                    std::int64_t x, const std::vector<Rational>& state, int& tries) {
  PointDynamics dynamics(spec);
  std::size_t longest = 0;
  for (std::int64_t u = 0; ways.delay[at(x)] > 0 && u < a.inputs.count() && --tries > 0; ++u) {
    if (!ways.is_choice(x, u)) continue;
    const auto cells = post_cells(a, x, u);
    if (!cells || cells->empty()) continue;
    std::vector<Rational> next = state;
    const std::optional<std::int64_t> y = real_step(spec, a, dynamics, next, u);
    if (!y || ways.delay[at(*y)] != ways.delay[at(x)] - 1) continue;
    if (std::find(cells->begin(), cells->end(), *y) == cells->end()) continue;
    longest = std::max(longest, 1 + longest_followed(spec, a, ways, *y, next, tries));
  }
  return longest;
}

/// A story is one of those that the system itself follows longest.
inline void expect_longest(const ProblemSpec& spec, const Abstraction& a, const ResultPath& path,
                           const ShortestWays& ways) {
  PointDynamics dynamics(spec);
  const auto first = static_cast<std::int64_t>(path.cell.front());
  std::vector<Rational> state;
  for (std::size_t i = 0; i < a.grid.size(); ++i) state.push_back(a.grid[i].point(a.grid.index(first, i)));
  int tries = 20'000;
  const std::size_t longest = longest_followed(spec, a, ways, first, state, tries);
  if (tries <= 0) return;
  const auto most = static_cast<std::size_t>(std::max(ways.delay[at(first)], 0));
  std::size_t followed = 0;
  while (followed < most && real_step(spec, a, dynamics, state, input_of(a, path, followed)) ==
                                static_cast<std::int64_t>(path.cell[followed + 1]))
    ++followed;
  RC_ASSERT(followed == longest);
  RC_CLASSIFY(longest > 1 && longest < most, "followed for some steps");
}

}  // namespace coordreq
