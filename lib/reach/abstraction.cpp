#include "reach/abstraction.hpp"

#include <algorithm>

#include "base/requires.hpp"
#include "model/odometer.hpp"

namespace coordreq {
namespace {

IndexRange read(const Abstraction& a, const TransitionTable& table, std::size_t state, std::int64_t x,
                std::int64_t u) {
  return table.range(
      state, [&](std::size_t s) { return a.grid.index(x, s); },
      [&](std::size_t s) { return a.inputs.index(u, s); });
}

}  // namespace

bool TransitionTable::has_term(std::size_t state) const {
  return std::any_of(terms.begin(), terms.end(), [&](const TransitionTerm& term) {
    return static_cast<std::size_t>(term.state) == state;
  });
}

std::uint64_t TransitionTable::bytes() const {
  std::uint64_t numbers = base_lower.size() + base_upper.size();
  for (const TransitionTerm& term : terms) numbers += term.lower.size() + term.upper.size();
  return entries.size() * sizeof(IndexRange) + numbers * sizeof(std::int64_t);
}

IndexRange Abstraction::raw(std::size_t i, std::int64_t x, std::int64_t u) const {
  return read(*this, tables[i], i, x, u);
}

ResolvedRange Abstraction::resolved(std::size_t i, std::int64_t x, std::int64_t u) const {
  return resolve(raw(i, x, u), grid[i].count, grid[i].below, grid[i].above);
}

IndexRange Abstraction::raw_tube(std::size_t i, std::int64_t x, std::int64_t u) const {
  REQUIRES(!tubes.empty());
  return read(*this, tubes[i], i, x, u);
}

ResolvedRange Abstraction::resolved_tube(std::size_t i, std::int64_t x, std::int64_t u) const {
  return resolve(raw_tube(i, x, u), grid[i].count, grid[i].below, grid[i].above);
}

namespace {

/// They run fastest. @returns entries of one choice of states
std::int64_t lay_out_inputs(TransitionTable& table, const InputSpace& inputs) {
  table.input_stride.assign(inputs.size(), 0);
  std::int64_t entries = 1;
  for (auto it = table.inputs.rbegin(); it != table.inputs.rend(); ++it) {
    const auto j = static_cast<std::size_t>(*it);
    table.input_stride[j] = entries;
    entries *= inputs[j].count();
  }
  return entries;
}

}  // namespace

std::int64_t lay_out(TransitionTable& table, std::size_t state, const UniformGrid& grid,
                     const InputSpace& inputs) {
  table.state_stride.assign(grid.size(), 0);
  std::int64_t entries = lay_out_inputs(table, inputs);
  for (auto it = table.states.rbegin(); it != table.states.rend(); ++it) {
    const auto j = static_cast<std::size_t>(*it);
    if ((table.shift && j == state) || table.has_term(j)) continue;
    table.state_stride[j] = entries;
    entries *= grid[j].count;
  }
  return entries;
}

std::int64_t lay_out_by_cells(TransitionTable& table, const std::vector<std::size_t>& order,
                              const UniformGrid& grid, const InputSpace& inputs) {
  table.state_stride.assign(grid.size(), 0);
  std::int64_t entries = lay_out_inputs(table, inputs);
  for (std::size_t d = order.size(); d-- > 0;) {
    table.state_stride[order[d]] = entries;
    entries *= grid[order[d]].count;
  }
  return entries;
}

namespace {

std::vector<std::int64_t> arranged(const std::vector<std::int64_t>& strides,
                                   const std::vector<std::size_t>& order) {
  std::vector<std::int64_t> result;
  for (const std::size_t i : order) result.push_back(strides[i]);
  return result;
}

std::vector<TransitionTable> arranged(std::vector<TransitionTable> tables,
                                      const std::vector<std::size_t>& order) {
  std::vector<std::int32_t> dimension_of(order.size());
  for (std::size_t d = 0; d < order.size(); ++d) dimension_of[order[d]] = static_cast<std::int32_t>(d);
  std::vector<TransitionTable> result;
  for (std::size_t d = 0; d < tables.size(); ++d) {
    TransitionTable& table = result.emplace_back(std::move(tables[order[d]]));
    for (std::int32_t& j : table.states) j = dimension_of[static_cast<std::size_t>(j)];
    std::sort(table.states.begin(), table.states.end());
    table.state_stride = arranged(table.state_stride, order);
    for (TransitionTerm& term : table.terms) {
      term.state = dimension_of[static_cast<std::size_t>(term.state)];
      term.state_stride = arranged(term.state_stride, order);
    }
  }
  return result;
}

}  // namespace

Abstraction arranged(Abstraction abstraction, const std::vector<std::size_t>& order) {
  abstraction.grid = abstraction.grid.arranged(order);
  abstraction.tables = arranged(std::move(abstraction.tables), order);
  abstraction.tubes = arranged(std::move(abstraction.tubes), order);
  return abstraction;
}

TransitionTable written_out(const Abstraction& abstraction, std::size_t state) {
  const TransitionTable& table = abstraction.tables[state];
  if (!table.shift && !table.is_sum()) return table;
  TransitionTable result{.states = table.states, .inputs = table.inputs};
  result.entries.reserve(
      static_cast<std::size_t>(lay_out(result, state, abstraction.grid, abstraction.inputs)));
  std::vector<std::int64_t> counts;
  std::vector<std::size_t> of_state(abstraction.grid.size());  // positions among the counts
  std::vector<std::size_t> of_input(abstraction.inputs.size());
  for (const std::int32_t j : table.states) {
    of_state[static_cast<std::size_t>(j)] = counts.size();
    counts.push_back(abstraction.grid[static_cast<std::size_t>(j)].count);
  }
  for (const std::int32_t j : table.inputs) {
    of_input[static_cast<std::size_t>(j)] = counts.size();
    counts.push_back(abstraction.inputs[static_cast<std::size_t>(j)].count());
  }
  Odometer choice(counts);
  do {
    result.entries.push_back(table.range(
        state, [&](std::size_t s) { return choice.indices()[of_state[s]]; },
        [&](std::size_t s) { return choice.indices()[of_input[s]]; }));
  } while (choice.advance());
  return result;
}

}  // namespace coordreq
