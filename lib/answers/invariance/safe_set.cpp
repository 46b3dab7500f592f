#include "answers/invariance/safe_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.hpp"
#include "expression/cell_truth.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// The condition at all grid points; nothing if it permits all pairs.
std::optional<ConditionTable> condition_table(const PairCondition& condition, const ProblemSpec& spec,
                                              const Abstraction& abstraction,
                                              std::optional<RowShare::Range> leading, ThreadTeam& team) {
  const Program& allow = condition.program;
  if (allow.nodes.back().op == Operator::literal_true) return std::nullopt;
  const std::vector<std::uint32_t> slots = allow.variables();
  const bool asks_cells = !slots.empty() && slots.back() >= spec.states.size() + spec.inputs.size();
  const bool is_false = asks_cells || may_not_know(allow);
  const auto refuse = [&](const std::vector<std::int64_t>& indices) -> bool {
    if (is_false) return false;
    std::string location;
    for (const std::uint32_t slot : allow.variables()) {
      if (slot >= spec.states.size() + spec.inputs.size()) continue;  // a state's cell
      const bool is_state = slot < spec.states.size();
      const std::size_t i = is_state ? slot : slot - spec.states.size();
      const bool is_leading = leading && is_state && abstraction.grid.dimension_of(i) == 0;
      const std::int64_t k = indices[slot] + (is_leading ? leading->begin : 0);
      const Rational value = is_state ? abstraction.grid[abstraction.grid.dimension_of(i)].point(k)
                                      : abstraction.inputs[i].values[static_cast<std::size_t>(k)];
      location += fmt::format("{}{} = {}", location.empty() ? "" : ", ",
                              is_state ? spec.states[i].name : spec.inputs[i].name, to_text(value));
    }
    throw SpecError(fmt::format("{} cannot be decided at {}", condition.label, location), condition.pointer);
  };
  return ConditionTable(allow, abstraction.grid, abstraction.inputs, refuse, team, leading);
}

Sampling sampling_of(const ProblemSpec& spec) {
  return spec.abstraction.safe == Membership::inner ? Sampling::closed_cells : Sampling::centres;
}

bool undecided_is_false(const std::vector<std::int64_t>& /*indices*/) {
  return false;
}

/// The indices of the first dimension that some rows have; at least one.
RowShare::Range leading_indices(const UniformGrid& grid, RowShare::Range rows) {
  const std::int64_t first = std::min(rows.begin / grid.row_stride(0), grid[0].count - 1);
  return {first, std::max(first, (rows.end - 1) / grid.row_stride(0)) + 1};
}

/// Runs of rows, and the indices of the first dimension that they have.
struct LeadingRuns {
  RowShare::Range leading;
  std::vector<RowShare::Range> runs;
};

/// Joins runs that have neighbouring indices in the first dimension; all runs, if the condition does not
/// depend on that dimension.
std::vector<LeadingRuns> leading_runs(const Program& condition, const UniformGrid& grid,
                                      const std::vector<RowShare::Range>& runs) {
  const std::vector<std::uint32_t> slots = condition.variables();
  if (grid.across() == 0 || !std::ranges::binary_search(slots, static_cast<std::uint32_t>(grid.state(0))))
    return {{{0, grid[0].count}, runs}};
  std::vector<LeadingRuns> groups;
  for (const RowShare::Range run : runs) {
    if (run.begin == run.end) continue;
    const RowShare::Range leading = leading_indices(grid, run);
    if (groups.empty() || groups.back().leading.end < leading.begin) groups.push_back({leading, {}});
    groups.back().leading.end = leading.end;
    groups.back().runs.push_back(run);
  }
  return groups;
}

/// Adds cells of the table in some runs of rows. @param grid of the rows of the table
void add_rows(const ConditionTable& table, const UniformGrid& grid, const std::vector<RowShare::Range>& runs,
              ThreadTeam& team, CellSet& cells) {
  const std::size_t last = grid.size() - 1;
  std::int64_t subrows = 1;
  for (std::size_t i = grid.across(); i < last; ++i) subrows *= grid[i].count;
  for_each_row_of(team, runs, std::max<std::int64_t>(1, 1024 / subrows), [&](RowShare::Range range, int) {
    for (std::int64_t r = range.begin; r < range.end; ++r) {
      for (std::int64_t k = 0; k < subrows; ++k) {
        std::int64_t lane = 0;
        std::int64_t rest = k;
        for (std::size_t i = last; i-- > grid.across(); rest /= grid[i].count)
          lane += rest % grid[i].count * grid.stride(i);
        add_bits(table.row(r * subrows + k, 0), lane, cells.row(r));
      }
    }
  });
}

}  // namespace

void add_cells_that_satisfy(const Program& condition, const ProblemSpec& spec, const UniformGrid& grid,
                            const InputSpace& inputs, const std::vector<RowShare::Range>& runs,
                            ThreadTeam& team, CellSet& cells) {
  const UniformGrid plain = grid.in_rows({});  // its rows run along one dimension
  for (const LeadingRuns& group : leading_runs(condition, grid, runs)) {
    const ConditionTable table(condition, plain, inputs, sampling_of(spec), undecided_is_false, team,
                               Question::everywhere, group.leading);
    add_rows(table, grid, group.runs, team, cells);
  }
}

CellSet cells_that_satisfy(const Program& condition, const ProblemSpec& spec, const UniformGrid& grid,
                           const InputSpace& inputs, ThreadTeam& team, const RowShare* share) {
  CellSet cells(grid.rows(), grid.row_length());
  add_cells_that_satisfy(condition, spec, grid, inputs, held_rows(share, grid.rows()), team, cells);
  return cells;
}

CellSet safe_set(const ProblemSpec& spec, const Abstraction& abstraction, ThreadTeam& team) {
  return cells_that_satisfy(spec.safe, spec, abstraction.grid, abstraction.inputs, team);
}

CellSet subset_of(const CellSet& set, const CellSet& other, bool is_in, const RowShare* share) {
  CellSet result(set.rows(), set.row_length());
  for (const RowShare::Range run : held_rows(share, set.rows())) {
    for (std::int64_t r = run.begin; r < run.end; ++r) {
      for (std::size_t w = 0; w < result.row(r).size(); ++w)
        result.row(r)[w] = set.row(r)[w] & (is_in ? other.row(r)[w] : ~other.row(r)[w]);
    }
  }
  return result;
}

std::optional<PairTable> permitted_pairs(const PairCondition& condition, const ProblemSpec& spec,
                                         const Abstraction& abstraction, ThreadTeam& team,
                                         const RowShare* share) {
  const UniformGrid& grid = abstraction.grid;
  std::optional<RowShare::Range> leading;
  if (share != nullptr && grid.across() > 0) leading = leading_indices(grid, local_rows(share, grid.rows()));
  const auto table = condition_table(condition, spec, abstraction, leading, team);
  return table ? std::optional<PairTable>(std::in_place, *table) : std::nullopt;
}

PairRules pair_rules(const ProblemSpec& spec, const Abstraction& abstraction, ThreadTeam& team,
                     const PackedPairs* listed, const RowShare* share) {
  const UniformGrid& grid = abstraction.grid;
  const RowShare::Range rows = local_rows(share, grid.rows());
  PairRules rules;
  if (spec.controller.allow) {
    rules.permitted = permitted_pairs({*spec.controller.allow, "'allow'", "/controller/allow"}, spec,
                                      abstraction, team, share);
  }
  const PairTable* const permitted = rules.permitted ? &*rules.permitted : nullptr;
  if (listed != nullptr) rules.listed.emplace(grid, abstraction.inputs, *listed, permitted, rows, team);
  return rules;
}

}  // namespace coordreq
