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

Sampling sampling_of(const ProblemSpec& spec) {
  return spec.abstraction.safe == Membership::inner ? Sampling::closed_cells : Sampling::centres;
}

bool undecided_is_false(const std::vector<std::int64_t>& /*indices*/) {
  return false;
}

}  // namespace

CellCondition::CellCondition(const Program& condition, const ProblemSpec& spec, const UniformGrid& grid,
                             const InputSpace& inputs, ThreadTeam& team)
    : grid_(grid),
      plain_(grid.in_rows({})),
      table_(condition, plain_, inputs, sampling_of(spec), undecided_is_false, team, Question::everywhere) {
  for (std::size_t i = grid.across(); i + 1 < grid.size(); ++i) runs_of_row_ *= grid[i].count;
}

void CellCondition::add_cells(const std::vector<RowShare::Range>& runs, ThreadTeam& team,
                              CellSet& cells) const {
  const std::size_t last = grid_.size() - 1;
  for_each_row_of(team, runs, std::max<std::int64_t>(1, 1024 / runs_of_row_),
                  [&](RowShare::Range range, int) {
                    for (std::int64_t r = range.begin; r < range.end; ++r) {
                      for (std::int64_t k = 0; k < runs_of_row_; ++k) {
                        std::int64_t lane = 0;
                        std::int64_t rest = k;
                        for (std::size_t i = last; i-- > grid_.across(); rest /= grid_[i].count)
                          lane += rest % grid_[i].count * grid_.stride(i);
                        add_bits(table_.row(r * runs_of_row_ + k, 0), lane, cells.row(r));
                      }
                    }
                  });
}

bool CellCondition::has_cells(std::int64_t row) const {
  for (std::int64_t k = 0; k < runs_of_row_; ++k) {
    if (std::ranges::any_of(table_.row(row * runs_of_row_ + k, 0), [](auto word) { return word != 0; }))
      return true;
  }
  return false;
}

CellSet cells_that_satisfy(const Program& condition, const ProblemSpec& spec, const UniformGrid& grid,
                           const InputSpace& inputs, ThreadTeam& team, const RowShare* share) {
  const CellCondition found(condition, spec, grid, inputs, team);
  CellSet cells(grid.rows(), grid.row_length());
  found.add_cells(held_rows(share, grid.rows()), team, cells);
  return cells;
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
