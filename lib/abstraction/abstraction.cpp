#include "abstraction/abstraction.hpp"

namespace coordreq {

namespace {

IndexRange entry_of(const Abstraction& a, const TransitionTable& table, std::int64_t x, std::int64_t u) {
  std::int64_t entry = 0;
  for (const std::int32_t j : table.states) {
    const auto s = static_cast<std::size_t>(j);
    entry += a.grid.index(x, s) * table.state_stride[s];
  }
  for (const std::int32_t j : table.inputs) {
    const auto s = static_cast<std::size_t>(j);
    entry += a.inputs.index(u, s) * table.input_stride[s];
  }
  return table.entries[static_cast<std::size_t>(entry)];
}

}  // namespace

IndexRange Abstraction::raw(std::size_t i, std::int64_t x, std::int64_t u) const {
  return entry_of(*this, tables[i], x, u);
}

ResolvedRange Abstraction::resolved(std::size_t i, std::int64_t x, std::int64_t u) const {
  return resolve(raw(i, x, u), grid[i].count, grid[i].below, grid[i].above);
}

IndexRange Abstraction::raw_tube(std::size_t i, std::int64_t x, std::int64_t u) const {
  return entry_of(*this, tubes[i], x, u);
}

ResolvedRange Abstraction::resolved_tube(std::size_t i, std::int64_t x, std::int64_t u) const {
  return resolve(raw_tube(i, x, u), grid[i].count, grid[i].below, grid[i].above);
}

std::int64_t lay_out(TransitionTable& table, const UniformGrid& grid, const InputSpace& inputs) {
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
    table.state_stride[j] = entries;
    entries *= grid[j].count;
  }
  return entries;
}

}  // namespace coordreq
