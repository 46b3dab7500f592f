#include "answers/ground.hpp"

#include <algorithm>
#include <set>

#include "answers/invariance/safe_set.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "answers/share_ground.hpp"
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

/// The sets that a symmetry must keep: S, the cells of it that count as T, and S for tubes beyond limits, in
/// rows held.
std::vector<const CellSet*> safe_sets(const Ground& ground) {
  std::vector<const CellSet*> sets{&ground.safe};
  if (ground.over) sets.push_back(&*ground.over);
  if (ground.beyond) sets.push_back(&*ground.beyond);
  return sets;
}

/// Agents that can be exchanged.
std::vector<AbstractAgent> find_agents_alike(const Ground& ground) {
  std::vector<std::vector<std::int32_t>> inputs;
  for (const InputClass& own : agent_classes(ground.spec, ground.abstraction->inputs))
    inputs.push_back(own.inputs());
  const std::vector<AbstractAgent> all = abstract_agents(*ground.abstraction, inputs);
  return find_like_agents(*ground.abstraction, all, safe_sets(ground));
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
  if (dimensions.size() < 2) return std::nullopt;
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
  ground.safe = CellSet(rows, row_length);
  if (limits) ground.beyond = CellSet(rows, row_length);
  if (ground.spec.ends_at_goal) ground.over = CellSet(rows, row_length);
  const auto find_safe = [&](const std::vector<RowShare::Range>& runs) {
    add_cells_that_satisfy(ground.spec.safe, ground.spec, abstraction.grid, abstraction.inputs, runs, team,
                           ground.safe);
    if (limits) add_safe_beyond(*limits, ground.spec, abstraction, ground.safe, runs, team, *ground.beyond);
    if (ground.over) add_over(runs, team, ground);
  };
  // The engine has to know now that rows are shared; how they are cut may depend on the engine.
  const bool is_cut = ground.share.has_value();
  if (ground.ranks == nullptr) {
    find_safe({{0, rows}});
  } else if (!is_cut) {
    ground.share = nothing_owned(*ground.ranks);
  }
  ground.engine.emplace(abstraction, nullptr, ground.tubes(), ground.shared_rows());
  ground.hull.emplace(*ground.engine);
  if (ground.ranks != nullptr) share_ground(ground, is_cut, find_safe);
  ground.pairs = pair_rules(ground.spec, abstraction, team, ground.listed ? &ground.listed->pairs : nullptr,
                            ground.shared_rows());
  ground.engine->set_pairs(ground.pairs);
  ground.tiles = Tiles::find(*ground.engine, *ground.hull, ground.safe);
  if (ground.ranks == nullptr && ground.pairs.admissible() == nullptr)
    ground.like_agents = find_agents_alike(ground);
  ground.safe_cells = ground.count(ground.safe);
  if (ground.tiles && ground.over)
    ground.tiles_with_over =
        ground.tiles->refined(ground.tiles->tables(), number_rows(*ground.over, ground.shared_rows()));
  ground.over_cells = ground.over ? ground.count(*ground.over) : 0;
  ground.order.emplace(abstraction.grid);
}

}  // namespace coordreq
