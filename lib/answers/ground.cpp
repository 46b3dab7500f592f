#include "answers/ground.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <span>

#include "answers/invariance/safe_set.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "answers/row_cut.hpp"
#include "base/index.hpp"
#include "base/requires.hpp"
#include "engine/engine_sizes.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

/// The largest set of like agents that can be exchanged within classes, or by exchanging whole classes;
/// ascending.
std::vector<std::size_t> alike_in_classes(const std::vector<AbstractAgent>& agents,
                                          const std::vector<InputClass>& classes) {
  std::set<std::vector<std::int32_t>> all;
  for (const InputClass& own : classes) all.insert(own.inputs());
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

/// The symmetry that exchanges agents; nothing if there are none.
std::optional<RowSymmetry> symmetry_of(const UniformGrid& grid, const std::vector<AbstractAgent>& agents) {
  if (agents.empty()) return std::nullopt;
  std::vector<std::vector<std::size_t>> dimensions;
  for (const AbstractAgent& agent : agents) dimensions.push_back(agent.dimensions);
  return RowSymmetry(grid, dimensions);
}

/// The sets that a symmetry must keep: S, the cells of it that count as T, and S for tubes beyond limits, in
/// rows held.
std::vector<const CellSet*> safe_sets(const Ground& ground) {
  std::vector<const CellSet*> sets{&ground.safe};
  if (ground.over) sets.push_back(&*ground.over);
  if (ground.beyond) sets.push_back(&*ground.beyond);
  return sets;
}

/// Agents that can be exchanged in each of the sets.
std::vector<AbstractAgent> agents_alike_in(const Ground& ground, std::span<const CellSet* const> sets) {
  std::vector<std::vector<std::int32_t>> inputs;
  for (const InputClass& own : agent_classes(ground.spec, ground.abstraction->inputs))
    inputs.push_back(own.inputs());
  const std::vector<AbstractAgent> all = abstract_agents(*ground.abstraction, inputs);
  return find_like_agents(*ground.abstraction, all, sets);
}

/// More processes do not exchange agents: while the rows that each works out become fewer, it would have to
/// hold ever more permuted rows of its own and of others.
constexpr int kMostThatExchange = 8;

/// Agents that can be exchanged in every partition unless S forbids it: with several processes rows are cut
/// for these before S is known.
std::vector<AbstractAgent> agents_alike_but_for_safe_set(const Ground& ground, int ranks) {
  const ProblemSpec& spec = ground.spec;
  if (ranks > kMostThatExchange || is_cut_before_tables(ground.model) || ground.listed ||
      spec.controller.allow)
    return {};
  std::vector<AbstractAgent> agents = agents_alike_in(ground, {});
  for (const PartitionSpec& partition : spec.coordination.partitions) {
    const auto classes = input_classes(spec, ground.abstraction->inputs, partition);
    if (alike_in_classes(agents, classes).size() < agents.size()) return {};
  }
  return agents;
}

/// [row] not 0 for the rows that a process has to hold beside its own.
/// @param safe S in its own rows; null: all cells count as safe
std::vector<std::uint8_t> rows_needed(const RowHull& hull, const CellSet* safe, RowShare::Range own,
                                      const std::optional<RowSymmetry>& symmetry) {
  std::vector<std::uint8_t> is_needed = hull.rows_met(safe, own);
  if (!symmetry) return is_needed;
  std::fill(is_needed.begin() + own.begin, is_needed.begin() + own.end, std::uint8_t{1});
  for (std::int64_t row = 0; row < std::ssize(is_needed); ++row) {
    if (is_needed[at(row)] != 0) is_needed[at(symmetry->canonical_of(row))] = 1;
  }
  return is_needed;
}

/// Cuts the rows, unless they are cut, and finds S in the rows held. Together.
/// @param agents that are exchanged, or none
void share_rows(Ground& ground, bool is_cut, const std::vector<AbstractAgent>& agents,
                const std::function<void(const std::vector<RowShare::Range>&)>& find_safe) {
  const std::optional<RowSymmetry> symmetry = symmetry_of(ground.abstraction->grid, agents);
  if (!is_cut)
    *ground.share = {*ground.ranks,
                     cut_into_shares(ground.model, &*ground.engine, ground.ranks->count(), symmetry)};
  find_safe({ground.share->own()});
  ground.share->set_ghosts(rows_needed(*ground.hull, &ground.safe, ground.share->own(), symmetry));
  find_safe(ghost_rows(*ground.share));
  ground.engine->take_tube_sets();
}

/// Adds the cells of G, of a goal that ends the task, in some rows where S is known.
void add_over(const std::vector<RowShare::Range>& runs, ThreadTeam& team, Ground& ground) {
  const Abstraction& abstraction = *ground.abstraction;
  CellSet& over = *ground.over;
  add_cells_that_satisfy(*ground.spec.goal, ground.spec, abstraction.grid, abstraction.inputs, runs, team,
                         over);
  for (const RowShare::Range run : runs) {
    for (std::int64_t r = run.begin; r < run.end; ++r) {
      for (std::size_t w = 0; w < over.row(r).size(); ++w) over.row(r)[w] &= ground.safe.row(r)[w];
    }
  }
}

/// Takes the agents as alike if S is the same when they are exchanged, for every process, and no tile is
/// divided. Together. @returns whether they are taken as alike
bool take_like_agents(Ground& ground, const std::vector<AbstractAgent>& agents) {
  ground.like_agents = agents;
  const std::optional<RowSymmetry> symmetry = ground.symmetry(single_classes(ground.abstraction->inputs));
  const bool can = symmetry && std::ranges::all_of(safe_sets(ground), [&](const CellSet* set) {
                     return symmetry->keeps(*set, ground.share->own());
                   });
  if (ground.ranks->sum(can ? 0 : 1) == 0) return true;
  ground.like_agents.clear();
  return false;
}

}  // namespace

TubeSets Ground::tubes() const {
  REQUIRES(safe.rows() == abstraction->grid.rows());
  if (abstraction->tubes.empty()) return {};
  return {&safe, beyond ? &*beyond : nullptr};
}

std::int64_t Ground::count(const CellSet& set) const {
  const RowShare::Range own = own_rows(shared_rows(), set.rows());
  return sum_of_all(shared_rows(), set.count(own.begin, own.end));
}

std::optional<RowSymmetry> Ground::symmetry(const std::vector<InputClass>& classes) const {
  std::vector<std::vector<std::size_t>> dimensions;
  for (const std::size_t a : alike_in_classes(like_agents, classes))
    dimensions.push_back(like_agents[a].dimensions);
  // Each of several processes holds the canonical rows of all its rows, if there is a symmetry.
  if (dimensions.size() < 2 || (ranks != nullptr && dimensions.size() < like_agents.size()))
    return std::nullopt;
  // Tiles of many rows are worked out as a whole.
  const auto is_in_tile = [&](std::size_t d) { return d >= tiles->leading(); };
  const bool is_any_in_tile =
      tiles && tiles->rows() > 1 &&
      std::ranges::any_of(dimensions, [&](const auto& own) { return std::ranges::any_of(own, is_in_tile); });
  if (is_any_in_tile) return std::nullopt;
  return RowSymmetry(abstraction->grid, dimensions);
}

void lay_ground(Ground& ground, ThreadTeam& team) {
  const Abstraction& abstraction = *ground.abstraction;
  const std::int64_t rows = abstraction.grid.rows(), row_length = abstraction.grid.row_length();
  const std::optional<TubeLimits> limits = find_tube_limits(ground.spec, abstraction, ground.ranks);
  const auto clear_safe = [&] {
    ground.safe = CellSet(rows, row_length);
    if (limits) ground.beyond = CellSet(rows, row_length);
    if (ground.spec.ends_at_goal) ground.over = CellSet(rows, row_length);
  };
  clear_safe();
  const auto find_safe = [&](const std::vector<RowShare::Range>& runs) {
    add_cells_that_satisfy(ground.spec.safe, ground.spec, abstraction.grid, abstraction.inputs, runs, team,
                           ground.safe);
    if (limits) add_safe_beyond(*limits, ground.spec, abstraction, ground.safe, runs, team, *ground.beyond);
    if (ground.over) add_over(runs, team, ground);
  };
  if (ground.ranks == nullptr) find_safe({{0, rows}});
  // The engine has to know now that rows are shared; how they are cut may depend on the engine.
  const bool is_cut = ground.share.has_value();
  if (ground.ranks != nullptr && !is_cut)
    ground.share.emplace(*ground.ranks,
                         std::vector<std::int64_t>(1 + static_cast<std::size_t>(ground.ranks->count()), 0));
  ground.engine.emplace(abstraction, nullptr, ground.tubes(), ground.shared_rows());
  ground.hull.emplace(*ground.engine);
  const std::vector<AbstractAgent> agents =
      ground.ranks == nullptr ? std::vector<AbstractAgent>()
                              : agents_alike_but_for_safe_set(ground, ground.ranks->count());
  if (ground.ranks != nullptr) share_rows(ground, is_cut, agents, find_safe);
  ground.pairs = pair_rules(ground.spec, abstraction, team, ground.listed ? &ground.listed->pairs : nullptr,
                            ground.shared_rows());
  ground.engine->set_pairs(ground.pairs);
  ground.tiles = Tiles::find(*ground.engine, *ground.hull, ground.safe);
  if (ground.ranks == nullptr && ground.pairs.admissible() == nullptr)
    ground.like_agents = agents_alike_in(ground, safe_sets(ground));
  if (!agents.empty() && !take_like_agents(ground, agents)) {
    clear_safe();
    share_rows(ground, is_cut, {}, find_safe);
    ground.tiles = Tiles::find(*ground.engine, *ground.hull, ground.safe);
  }
  ground.safe_cells = ground.count(ground.safe);
  if (ground.tiles && ground.over)
    ground.tiles_with_over =
        ground.tiles->refined(ground.tiles->tables(), number_rows(*ground.over, ground.shared_rows()));
  ground.over_cells = ground.over ? ground.count(*ground.over) : 0;
  ground.order.emplace(abstraction.grid);
}

std::vector<RankRows> rows_of_ranks(const Ground& ground, int ranks) {
  const UniformGrid& grid = ground.abstraction->grid;
  const CellSet unknown(grid.rows(), grid.row_length());
  TubeSets tubes;
  if (!ground.abstraction->tubes.empty()) tubes = {.inside = &unknown, .are_known = false};
  const RowEngine engine(*ground.abstraction, nullptr, tubes);
  const RowHull hull(engine);
  const std::optional<RowSymmetry> symmetry = symmetry_of(grid, agents_alike_but_for_safe_set(ground, ranks));
  const std::vector<std::int64_t> bounds = cut_into_shares(ground.model, &engine, ranks, symmetry);
  const std::vector<double> slices = bytes_of_slices(engine);
  std::vector<RankRows> result;
  for (std::size_t r = 0; r + 1 < bounds.size(); ++r) {
    const RowShare::Range own{bounds[r], bounds[r + 1]};
    std::vector<std::uint8_t> is_needed = rows_needed(hull, nullptr, own, symmetry);
    std::fill(is_needed.begin() + own.begin, is_needed.begin() + own.end, std::uint8_t{0});
    RankRows& rows = result.emplace_back(
        RankRows{own.end - own.begin, std::count(is_needed.begin(), is_needed.end(), 1), slices});
    for (std::size_t t = 0; t < slices.size(); ++t) {
      if (ground.abstraction->tables[t].is_by_cells(grid.size()))
        rows.slices[t] *= static_cast<double>(rows.own) / static_cast<double>(grid.rows());
    }
  }
  return result;
}

}  // namespace coordreq
