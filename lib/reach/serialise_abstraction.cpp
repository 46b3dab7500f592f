#include "reach/build_abstraction.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/requires.hpp"
#include "reach/affine_dynamics.hpp"
#include "reach/affine_part.hpp"
#include "reach/scaled_number.hpp"
#include "reach/tables.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

constexpr std::int64_t kNumbersOfEntry = 2;
static_assert(sizeof(IndexRange) == kNumbersOfEntry * sizeof(std::int32_t));

/// Rows of cells along the last state, with all their entries.
void serialise_by_cells(Archive& archive, const UniformGrid& grid, const HeldCells& held,
                        TransitionTable& table) {
  const std::size_t last = grid.dimension_of(held.order.back());
  const std::int64_t row = grid[last].count, entries = table.state_stride[last] * row;
  const ThreadTeam::Range local{held.begin / row, held.end / row};
  NumberRows rows = number_rows<std::int32_t>(nullptr, kNumbersOfEntry * entries, grid.points() / row,
                                              kNumbersOfEntry * entries);
  if (local.begin < local.end)
    rows.first = reinterpret_cast<std::byte*>(table.entries.data()) - local.begin * rows.stride;
  archive.grid_rows(rows, local, {&local, 1});
}

void serialise_entries(Archive& archive, const UniformGrid& grid, const std::optional<HeldCells>& held,
                       TransitionTable& table) {
  std::vector<IndexRange>& entries = table.entries;
  const auto count = static_cast<std::int64_t>(entries.size());
  if (held && table.is_by_cells(grid.size())) {
    serialise_by_cells(archive, grid, *held, table);
  } else if (count > 0) {
    archive.rows(number_rows(&entries.front().first, kNumbersOfEntry * count, 1, kNumbersOfEntry * count));
  }
  archive.expect(
      std::all_of(entries.begin(), entries.end(), [](IndexRange entry) { return entry.first <= entry.last; }),
      "a range of indices ends before it begins");
}

/// The ends of a term of a sum.
void serialise(Archive& archive, std::vector<std::int64_t>& lower, std::vector<std::int64_t>& upper) {
  constexpr auto kMost = static_cast<std::int64_t>(kLargestTerm * 0x1p32) + 2 * kHalfStep;
  archive.list(lower);
  archive.list(upper);
  bool fits = true;
  for (std::size_t i = 0; archive.is_loading() && i < lower.size(); ++i)
    fits = fits && -kMost <= lower[i] && lower[i] <= upper[i] && upper[i] <= kMost;
  archive.expect(fits, "a summand of a range is none");
}

/// The structure is known from the spec.
void serialise(Archive& archive, const UniformGrid& grid, const std::optional<HeldCells>& held,
               TransitionTable& table) {
  // All members have a name here, so that one that is added does not compile before it is dealt with.
  auto& [states, inputs, shift, entries, terms, base_lower, base_upper, before, state_stride, input_stride] =
      table;
  static_cast<void>(states), static_cast<void>(inputs), static_cast<void>(shift);
  static_cast<void>(before), static_cast<void>(state_stride), static_cast<void>(input_stride);
  static_cast<void>(entries);
  serialise_entries(archive, grid, held, table);
  for (TransitionTerm& term : terms) {
    auto& [of_state, term_state_stride, term_input_stride, lower, upper] = term;
    static_cast<void>(of_state), static_cast<void>(term_state_stride), static_cast<void>(term_input_stride);
    serialise(archive, lower, upper);
  }
  serialise(archive, base_lower, base_upper);
}

/// The grid is that of make_grid().
[[maybe_unused]] bool has_cells_of(const UniformGrid& grid, const SystemSpec& spec) {
  if (grid.size() != spec.states.size() || grid.across() + 1 != grid.size()) return false;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (grid.state(i) != i || grid[i].count != spec.states[i].grid.count) return false;
  }
  return true;
}

}  // namespace

void serialise(Archive& archive, const SystemSpec& spec, Abstraction& abstraction) {
  auto& [grid, inputs, tables, tubes, exact, held] = abstraction;
  REQUIRES(!archive.is_loading() || (has_cells_of(grid, spec) && inputs.size() == spec.inputs.size()));
  const AffineDynamics dynamics(spec);
  tables.resize(grid.size());
  if (spec.abstraction.between_samples) tubes.resize(grid.size());
  auto is_exact = static_cast<std::uint8_t>(exact ? 1 : 0);
  archive.number(is_exact);
  exact = is_exact != 0;
  for (std::size_t state = 0; state < grid.size(); ++state) {
    const std::size_t d = grid.dimension_of(state);
    auto is_sum = static_cast<std::uint8_t>(tables[d].is_sum() ? 1 : 0);
    archive.number(is_sum);
    if (archive.is_loading()) {
      const Dependencies& dependencies = dynamics.dependencies(d);
      const AffinePart part = find_affine_part(spec, dependencies, d);
      archive.expect(is_sum == 0 || !summed_states(spec, dependencies, part, d).empty(), "a table is a sum");
      tables[d] = is_sum == 0 ? full_layout(spec, dependencies, d, abstraction)
                              : sum_layout(spec, dependencies, part, d, grid, inputs);
    }
    serialise(archive, grid, held, tables[d]);
    if (tubes.empty()) continue;
    if (archive.is_loading()) tubes[d] = full_layout(spec, dynamics.dependencies(d), d, abstraction);
    serialise(archive, grid, held, tubes[d]);
  }
}

}  // namespace coordreq
