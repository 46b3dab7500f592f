#include "abstraction/abstraction.hpp"

#include "abstraction/counter.hpp"

namespace coordreq {
namespace {

IndexRange entry_of(const Abstraction& a, const TransitionTable& table, std::size_t state, std::int64_t x,
                    std::int64_t u) {
  std::int64_t entry = 0;
  for (const std::int32_t j : table.states) {
    const auto s = static_cast<std::size_t>(j);
    entry += a.grid.index(x, s) * table.state_stride[s];
  }
  for (const std::int32_t j : table.inputs) {
    const auto s = static_cast<std::size_t>(j);
    entry += a.inputs.index(u, s) * table.input_stride[s];
  }
  return table.range(entry, a.grid.index(x, state));
}

}  // namespace

IndexRange Abstraction::raw(std::size_t i, std::int64_t x, std::int64_t u) const {
  return entry_of(*this, tables[i], i, x, u);
}

ResolvedRange Abstraction::resolved(std::size_t i, std::int64_t x, std::int64_t u) const {
  return resolve(raw(i, x, u), grid[i].count, grid[i].below, grid[i].above);
}

IndexRange Abstraction::raw_tube(std::size_t i, std::int64_t x, std::int64_t u) const {
  return entry_of(*this, tubes[i], i, x, u);
}

ResolvedRange Abstraction::resolved_tube(std::size_t i, std::int64_t x, std::int64_t u) const {
  return resolve(raw_tube(i, x, u), grid[i].count, grid[i].below, grid[i].above);
}

std::int64_t lay_out(TransitionTable& table, std::size_t state, const UniformGrid& grid,
                     const InputSpace& inputs) {
  table.state_stride.assign(grid.size(), 0);
  table.input_stride.assign(inputs.size(), 0);
  std::int64_t entries = 1;
  for (auto it = table.inputs.rbegin(); it != table.inputs.rend(); ++it) {
    const auto j = static_cast<std::size_t>(*it);
    table.input_stride[j] = entries;
    entries *= inputs[j].count();
  }
  for (auto it = table.states.rbegin(); it != table.states.rend(); ++it) {
    const auto j = static_cast<std::size_t>(*it);
    if (table.shift && j == state) continue;
    table.state_stride[j] = entries;
    entries *= grid[j].count;
  }
  return entries;
}

TransitionTable written_out(const Abstraction& abstraction, std::size_t state) {
  const TransitionTable& table = abstraction.tables[state];
  if (!table.shift) return table;
  TransitionTable result{.states = table.states, .inputs = table.inputs};
  result.entries.reserve(
      static_cast<std::size_t>(lay_out(result, state, abstraction.grid, abstraction.inputs)));
  std::vector<std::int64_t> counts;
  std::vector<std::int64_t> strides;
  std::size_t own = 0;
  for (const std::int32_t j : table.states) {
    const auto s = static_cast<std::size_t>(j);
    if (s == state) own = counts.size();
    counts.push_back(abstraction.grid[s].count);
    strides.push_back(table.state_stride[s]);
  }
  for (const std::int32_t j : table.inputs) {
    const auto s = static_cast<std::size_t>(j);
    counts.push_back(abstraction.inputs[s].count());
    strides.push_back(table.input_stride[s]);
  }
  Counter choice(counts);
  do {
    std::int64_t position = 0;
    for (std::size_t v = 0; v < counts.size(); ++v) position += choice.indices()[v] * strides[v];
    result.entries.push_back(table.range(position, choice.indices()[own]));
  } while (choice.next());
  return result;
}

}  // namespace coordreq
