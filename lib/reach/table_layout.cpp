#include "reach/tables.hpp"

#include "base/requires.hpp"
#include "reach/shift.hpp"

namespace coordreq {
namespace {

TransitionTable bare_table(const SystemSpec& spec, const Dependencies& dependencies, std::size_t state) {
  return {.states = dependencies.all_states(),
          .inputs = dependencies.inputs,
          .shift = is_shift(spec, dependencies, state)};
}

/// The source runs fastest, so that a row along it lies together.
TransitionTerm term_layout(std::int32_t state, const AffinePart& part, const UniformGrid& grid,
                           const InputSpace& inputs) {
  const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
  TransitionTerm term{.state = state};
  term.state_stride.assign(grid.size(), 0);
  term.input_stride.assign(inputs.size(), 0);
  term.state_stride[at(state)] = 1;
  std::int64_t size = grid[at(state)].count;
  for (const std::int32_t i : part.inputs) {
    term.input_stride[at(i)] = size;
    size *= inputs[at(i)].count();
  }
  for (const std::int32_t i : part.parameters) {
    term.state_stride[at(i)] = size;
    size *= grid[at(i)].count;
  }
  term.lower.resize(static_cast<std::size_t>(size));
  term.upper.resize(static_cast<std::size_t>(size));
  return term;
}

}  // namespace

TransitionTable full_layout(const SystemSpec& spec, const Dependencies& dependencies, std::size_t state,
                            const Abstraction& abstraction) {
  const auto& [grid, inputs, tables, tubes, exact, held] = abstraction;
  TransitionTable table = bare_table(spec, dependencies, state);
  std::int64_t entries = 0;
  if (held && table.is_by_cells(grid.size())) {
    const std::int64_t of_cell = lay_out_by_cells(table, held->order, grid, inputs) / grid.points();
    table.before = held->begin * of_cell;
    entries = (held->end - held->begin) * of_cell;
  } else {
    entries = lay_out(table, state, grid, inputs);
  }
  table.entries.resize(static_cast<std::size_t>(entries));
  return table;
}

TransitionTable sum_layout(const SystemSpec& spec, const Dependencies& dependencies, const AffinePart& part,
                           std::size_t state, const UniformGrid& grid, const InputSpace& inputs) {
  TransitionTable table = bare_table(spec, dependencies, state);
  for (const std::int32_t j : summed_states(spec, dependencies, part, state))
    table.terms.push_back(term_layout(j, part, grid, inputs));
  REQUIRES(!table.terms.empty());
  const auto entries = static_cast<std::size_t>(lay_out(table, state, grid, inputs));
  table.base_lower.resize(entries);
  table.base_upper.resize(entries);
  return table;
}

}  // namespace coordreq
