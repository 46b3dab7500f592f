#include "answers/analysis_context.hpp"

#include <algorithm>
#include <atomic>
#include <set>

#include "answers/invariance/safe_set.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "answers/share_context.hpp"
#include "base/index.hpp"
#include "base/requires.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// The largest set of like agents that can be exchanged within classes, or by exchanging whole classes;
/// ascending.
std::vector<std::size_t> alike_in_classes(const std::vector<AbstractAgent>& agents,
                                          const std::vector<InputClass>& classes) {
  std::set<std::vector<std::int32_t>> all;
  for (const InputClass& input_class : classes) all.insert(input_class.inputs());
  const auto are_alike = [&](const AbstractAgent& a, const AbstractAgent& b) {
    return std::ranges::all_of(all, [&](std::vector<std::int32_t> inputs) {
      for (std::int32_t& input : inputs) input = exchanged(a.inputs, b.inputs, input);
      std::ranges::sort(inputs);
      return all.contains(inputs);
    });
  };
  std::vector<std::size_t> most;
  for (std::size_t a = 0; a < agents.size(); ++a) {
    std::vector<std::size_t> like{a};
    for (std::size_t b = a + 1; b < agents.size(); ++b) {
      if (are_alike(agents[a], agents[b])) like.push_back(b);
    }
    if (like.size() > most.size()) most = std::move(like);
  }
  return most;
}

/// The sets that a symmetry must keep: S, the cells of it that count as T, and S for tubes beyond limits, in
/// rows held.
std::vector<const CellSet*> safe_sets(const AnalysisContext& context) {
  std::vector<const CellSet*> sets{&context.safe};
  if (context.terminal) sets.push_back(&*context.terminal);
  if (context.beyond) sets.push_back(&*context.beyond);
  return sets;
}

/// Agents that can be exchanged.
std::vector<AbstractAgent> find_agents_alike(const AnalysisContext& context, ThreadTeam& team) {
  std::vector<std::vector<std::int32_t>> inputs;
  for (const InputClass& input_class : agent_classes(context.spec, context.abstraction->inputs))
    inputs.push_back(input_class.inputs());
  const std::vector<AbstractAgent> all = abstract_agents(*context.abstraction, inputs);
  return find_like_agents(*context.abstraction, all, safe_sets(context), &team);
}

/// Adds the cells of G, of a goal that ends the task, in some rows where S is known.
void add_terminal(const std::vector<RowShare::Range>& runs, ThreadTeam& team, AnalysisContext& context) {
  const Abstraction& abstraction = *context.abstraction;
  CellSet& terminal = *context.terminal;
  add_cells_that_satisfy(*context.spec.goal, context.spec, abstraction.grid, abstraction.inputs, runs, team,
                         terminal);
  for (const RowShare::Range run : runs) {
    for (std::int64_t r = run.begin; r < run.end; ++r) {
      for (std::size_t w = 0; w < terminal.row(r).size(); ++w) terminal.row(r)[w] &= context.safe.row(r)[w];
    }
  }
}

}  // namespace

TubeSets AnalysisContext::tubes() const {
  REQUIRES(safe.rows() == abstraction->grid.rows());
  if (abstraction->tubes.empty()) return {};
  return {&safe, beyond ? &*beyond : nullptr};
}

std::int64_t AnalysisContext::count(const CellSet& set, ThreadTeam* team) const {
  const RowShare::Range local = local_rows(shared_rows(), set.rows());
  std::atomic<std::int64_t> cells = 0;
  for_each(team, local.end - local.begin, 256, [&](ThreadTeam::Range rows, int) {
    cells += set.count(local.begin + rows.begin, local.begin + rows.end);
  });
  return sum_of_all(shared_rows(), cells);
}

std::optional<RowSymmetry> AnalysisContext::symmetry(const std::vector<InputClass>& classes) const {
  std::vector<std::vector<std::size_t>> dimensions;
  for (const std::size_t a : alike_in_classes(like_agents, classes))
    dimensions.push_back(like_agents[a].dimensions);
  if (dimensions.size() < 2) return std::nullopt;
  // Tiles of many rows are computed as a whole.
  const auto is_in_tile = [&](std::size_t d) { return d >= tiles->leading(); };
  const bool is_any_in_tile =
      tiles && tiles->rows() > 1 && std::ranges::any_of(dimensions, [&](const auto& indices) {
        return std::ranges::any_of(indices, is_in_tile);
      });
  if (is_any_in_tile) return std::nullopt;
  return RowSymmetry(abstraction->grid, dimensions);
}

void set_up_context(AnalysisContext& context, ThreadTeam& team) {
  const Abstraction& abstraction = *context.abstraction;
  const std::int64_t rows = abstraction.grid.rows(), row_length = abstraction.grid.row_length();
  const std::optional<TubeLimits> limits = find_tube_limits(context.spec, abstraction, context.ranks);
  context.safe = CellSet(rows, row_length);
  if (limits) context.beyond = CellSet(rows, row_length);
  if (context.spec.ends_at_goal()) context.terminal = CellSet(rows, row_length);
  const auto find_safe = [&](const std::vector<RowShare::Range>& runs) {
    add_cells_that_satisfy(context.spec.safe, context.spec, abstraction.grid, abstraction.inputs, runs, team,
                           context.safe);
    if (limits)
      add_safe_beyond(*limits, context.spec, abstraction, context.safe, runs, team, *context.beyond);
    if (context.terminal) add_terminal(runs, team, context);
  };
  // The engine has to know now that rows are shared; how they are cut may depend on the engine.
  const bool is_cut = context.share.has_value();
  if (context.ranks == nullptr) {
    find_safe({{0, rows}});
  } else if (!is_cut) {
    context.share = nothing_owned(*context.ranks);
  }
  context.engine.emplace(abstraction, nullptr, context.tubes(), context.shared_rows(), &team);
  context.hull.emplace(*context.engine, &team);
  if (context.ranks != nullptr) share_context(context, is_cut, find_safe);
  context.pairs = pair_rules(context.spec, abstraction, team,
                             context.listed ? &context.listed->pairs : nullptr, context.shared_rows());
  context.engine->set_pairs(context.pairs);
  context.tiles = Tiles::find(*context.engine, *context.hull, context.safe, &team);
  if (context.ranks == nullptr && context.pairs.admissible() == nullptr)
    context.like_agents = find_agents_alike(context, team);
  context.safe_cells = context.count(context.safe, &team);
  if (context.tiles && context.terminal)
    context.tiles_with_terminal = context.tiles->refined(
        context.tiles->tables(), number_rows(*context.terminal, context.shared_rows(), &team), &team);
  context.terminal_cells = context.terminal ? context.count(*context.terminal, &team) : 0;
  context.order.emplace(abstraction.grid);
}

}  // namespace coordreq
