#include "answers/counterexample/nominal_run.hpp"

#include <cmath>
#include <utility>

#include "base/index.hpp"
#include "base/requires.hpp"
#include "model/sample_reset.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// Exact numbers grow from step to step: shortens those with more bits than a counterexample needs.
Rational shortened(const Rational& value) {
  constexpr std::size_t kBits = 4096;
  const bool is_long =
      mpz_sizeinbase(value.get_num_mpz_t(), 2) > kBits || mpz_sizeinbase(value.get_den_mpz_t(), 2) > kBits;
  if (!is_long) return value;
  const double nearest = nearest_double(value);
  return std::isfinite(nearest) ? exact(nearest) : value;
}

}  // namespace

NominalRun::NominalRun(const SystemSpec& spec, const Abstraction& abstraction)
    : spec_(spec),
      abstraction_(abstraction),
      dynamics_(spec),
      slots_(spec.slot_count()),
      known_(spec.states.size()) {
  for (std::size_t l = 0; l < spec.disturbances.size(); ++l) {
    const DisturbanceSpec& w = spec.disturbances[l];
    slots_[spec.disturbance_slot(l)] = (w.lower + w.upper) / 2;
  }
}

const GridDimension& NominalRun::dimension(std::size_t state) const {
  return abstraction_.grid[abstraction_.grid.dimension_of(state)];
}

void NominalRun::start(std::vector<Rational> state) {
  for (std::size_t i = 0; i < state.size(); ++i) slots_[spec_.state_slot(i)] = state[i];
  for (auto& of_state : known_) of_state.clear();
  state_ = std::move(state);
}

void NominalRun::start(std::int64_t cell) {
  const UniformGrid& grid = abstraction_.grid;
  std::vector<Rational> state(grid.size());
  for (std::size_t d = 0; d < grid.size(); ++d) state[grid.state(d)] = grid[d].point(grid.index(cell, d));
  start(std::move(state));
}

/// The next value of a state that is no memory.
std::optional<Rational> NominalRun::next(std::size_t state, std::int64_t u) {
  const InputSpace& inputs = abstraction_.inputs;
  std::int64_t key = 0;
  for (const std::int32_t j : dynamics_.dependencies(state).inputs)
    key += inputs.index(u, at(j)) * inputs.stride(at(j));
  const auto [entry, is_new] = known_[state].try_emplace(key);
  if (!is_new) return entry->second;
  for (const std::int32_t j : dynamics_.dependencies(state).inputs)
    slots_[spec_.input_slot(at(j))] = inputs[at(j)].values[at(inputs.index(u, at(j)))];
  if (const std::optional<Rational> value = dynamics_.next(state, slots_))
    entry->second = shortened(reset_at_sample(dimension(state), *value));
  return entry->second;
}

NominalRun::Successor NominalRun::after(std::int64_t cell, std::int64_t u) {
  REQUIRES(is_followed());
  const UniformGrid& grid = abstraction_.grid;
  std::vector<Rational> point(grid.size());
  for (std::size_t d = 0; d < grid.size(); ++d) {
    const std::size_t state = grid.state(d);
    if (spec_.dynamics.is_kept(state)) {
      point[d] = grid[d].point(abstraction_.raw(d, cell, u).first);
      continue;
    }
    const std::optional<Rational> value = next(state, u);
    if (!value) return {};
    point[d] = *value;
  }
  const Location location = locate(grid, point);
  return {.is_known = true, .kind = location.kind, .cell = location.cell};
}

void NominalRun::advance(std::int64_t u, const Successor& successor) {
  if (!successor.is_known || successor.kind != Location::Kind::cell) return stop();
  std::vector<Rational> reached(spec_.states.size());
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const std::size_t d = abstraction_.grid.dimension_of(i);
    reached[i] = spec_.dynamics.is_kept(i)
                     ? abstraction_.grid[d].point(abstraction_.grid.index(successor.cell, d))
                     : next(i, u).value();
  }
  start(std::move(reached));
}

}  // namespace coordreq
