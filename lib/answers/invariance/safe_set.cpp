#include "answers/invariance/safe_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "expression/cell_truth.hpp"

namespace coordreq {
namespace {

/// `allow` at all grid points; nothing if it permits everything.
std::optional<ConditionTable> condition_table(const ProblemSpec& spec, const Abstraction& abstraction,
                                              ThreadTeam& team) {
  if (!spec.controller.allow) return std::nullopt;
  const Program& allow = *spec.controller.allow;
  if (allow.nodes.back().op == Operator::literal_true) return std::nullopt;
  const std::vector<std::uint32_t> slots = allow.variables();
  const bool asks_cells = !slots.empty() && slots.back() >= spec.states.size() + spec.inputs.size();
  const bool is_false = asks_cells || may_not_know(allow);
  const auto refuse = [&](const std::vector<std::int64_t>& indices) -> bool {
    if (is_false) return false;
    std::string place;
    for (const std::uint32_t slot : allow.variables()) {
      if (slot >= spec.states.size() + spec.inputs.size()) continue;  // a state's cell
      const bool is_state = slot < spec.states.size();
      const std::size_t i = is_state ? slot : slot - spec.states.size();
      const auto k = indices[slot];
      const Rational value = is_state ? abstraction.grid[abstraction.grid.dimension_of(i)].point(k)
                                      : abstraction.inputs[i].values[static_cast<std::size_t>(k)];
      place += fmt::format("{}{} = {}", place.empty() ? "" : ", ",
                           is_state ? spec.states[i].name : spec.inputs[i].name, to_text(value));
    }
    throw SpecError(fmt::format("'allow' cannot be decided at {}", place), "/controller/allow");
  };
  return ConditionTable(allow, abstraction.grid, abstraction.inputs, refuse, team);
}

/// The same cells in rows along several dimensions.
CellSet joined(const CellSet& runs, const UniformGrid& grid, ThreadTeam& team) {
  const std::size_t last = grid.size() - 1;
  std::int64_t runs_of_row = 1;
  for (std::size_t i = grid.across(); i < last; ++i) runs_of_row *= grid[i].count;
  CellSet rows(grid.rows(), grid.row_length());
  team.for_each(rows.rows(), 64, [&](ThreadTeam::Range range, int) {
    for (std::int64_t r = range.begin; r < range.end; ++r) {
      for (std::int64_t k = 0; k < runs_of_row; ++k) {
        std::int64_t lane = 0;
        std::int64_t rest = k;
        for (std::size_t i = last; i-- > grid.across(); rest /= grid[i].count)
          lane += rest % grid[i].count * grid.stride(i);
        add_bits(runs.row(r * runs_of_row + k), lane, rows.row(r));
      }
    }
  });
  return rows;
}

}  // namespace

CellSet cells_that_satisfy(const Program& condition, const ProblemSpec& spec, const UniformGrid& grid,
                           const InputSpace& inputs, ThreadTeam& team) {
  const Sampling sampling =
      spec.abstraction.safe == Membership::inner ? Sampling::closed_cells : Sampling::centres;
  const auto undecided_is_false = [](const std::vector<std::int64_t>&) { return false; };
  const UniformGrid plain = grid.in_rows({});
  const ConditionTable table(condition, plain, inputs, sampling, undecided_is_false, team,
                             Question::everywhere);
  CellSet cells(plain.rows(), plain.row_length());
  team.for_each(cells.rows(), 1024, [&](ThreadTeam::Range range, int) {
    for (std::int64_t r = range.begin; r < range.end; ++r) {
      const auto source = table.row(r, 0);
      std::copy(source.begin(), source.end(), cells.row(r).begin());
    }
  });
  return grid.across() == plain.across() ? std::move(cells) : joined(cells, grid, team);
}

std::optional<PairTable> allow_table(const ProblemSpec& spec, const Abstraction& abstraction,
                                     ThreadTeam& team, const PackedPairs* listed) {
  const std::optional<ConditionTable> allow = condition_table(spec, abstraction, team);
  if (listed != nullptr)
    return PairTable(abstraction.grid, abstraction.inputs, *listed, allow ? &*allow : nullptr, team);
  if (!allow) return std::nullopt;
  return PairTable(*allow);
}

}  // namespace coordreq
