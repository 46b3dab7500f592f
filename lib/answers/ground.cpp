#include "answers/ground.hpp"

#include <algorithm>
#include <set>

#include "answers/invariance/safe_set.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "answers/row_cut.hpp"
#include "engine/engine_sizes.hpp"

namespace coordreq {
namespace {

/// Of like agents the most that change places within the classes, or with whole classes; ascending.
std::vector<std::size_t> alike_in_classes(const std::vector<AgentPart>& agents,
                                          const std::vector<InputClass>& classes) {
  std::set<std::vector<std::int32_t>> all;
  for (const InputClass& own : classes) all.insert(own.inputs());
  const auto are_alike = [&](const AgentPart& a, const AgentPart& b) {
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

/// Of one process, where everything is allowed.
void look_for_like_agents(Ground& ground) {
  if (ground.ranks != nullptr || ground.allow) return;
  std::vector<std::vector<std::int32_t>> inputs;
  for (const InputClass& own : agent_classes(ground.spec, ground.abstraction->inputs))
    inputs.push_back(own.inputs());
  std::vector<const CellSet*> sets{&ground.safe};
  if (ground.beyond) sets.push_back(&*ground.beyond);
  const std::vector<AgentPart> parts = parts_of_agents(*ground.abstraction, inputs);
  ground.like_agents = find_like_agents(*ground.abstraction, parts, sets);
}

}  // namespace

TubeSets Ground::tubes() const {
  if (abstraction->tubes.empty()) return {};
  return {&safe, beyond ? &*beyond : nullptr};
}

std::int64_t Ground::count(const CellSet& set) const {
  const RowShare::Range own = own_rows(shared_rows(), set.rows());
  return sum_of_all(shared_rows(), set.count(own.begin, own.end));
}

std::optional<RowMirror> Ground::mirror(const std::vector<InputClass>& classes) const {
  std::vector<std::vector<std::size_t>> blocks;
  for (const std::size_t a : alike_in_classes(like_agents, classes))
    blocks.push_back(like_agents[a].dimensions);
  if (blocks.size() < 2) return std::nullopt;
  // Tiles of many rows are worked out as a whole.
  const auto is_in_tile = [&](std::size_t d) { return d >= tiles->leading(); };
  const bool is_any_in_tile =
      tiles && tiles->rows() > 1 &&
      std::ranges::any_of(blocks, [&](const auto& block) { return std::ranges::any_of(block, is_in_tile); });
  if (is_any_in_tile) return std::nullopt;
  return RowMirror(abstraction->grid, blocks);
}

void lay_ground(Ground& ground, ThreadTeam& team) {
  const Abstraction& abstraction = *ground.abstraction;
  const std::int64_t rows = abstraction.grid.rows(), row_length = abstraction.grid.row_length();
  ground.safe = CellSet(rows, row_length);
  const std::optional<TubeLimits> limits = find_tube_limits(ground.spec, abstraction, ground.ranks);
  if (limits) ground.beyond.emplace(rows, row_length);
  const auto find_safe = [&](const std::vector<RowShare::Range>& runs) {
    add_cells_that_satisfy(ground.spec.safe, ground.spec, abstraction.grid, abstraction.inputs, runs, team,
                           ground.safe);
    if (limits) add_safe_beyond(*limits, ground.spec, abstraction, ground.safe, runs, team, *ground.beyond);
  };
  if (ground.ranks == nullptr) find_safe({{0, rows}});
  // How it is cut may depend on the engine, which only has to know that it is.
  const bool is_cut = ground.share.has_value();
  if (ground.ranks != nullptr && !is_cut)
    ground.share.emplace(*ground.ranks,
                         std::vector<std::int64_t>(1 + static_cast<std::size_t>(ground.ranks->count()), 0));
  ground.engine.emplace(abstraction, nullptr, ground.tubes(), ground.shared_rows());
  ground.hull.emplace(*ground.engine);
  if (ground.ranks != nullptr) {
    if (!is_cut)
      *ground.share = {*ground.ranks, cut_into_shares(ground.model, &*ground.engine, ground.ranks->count())};
    find_safe({ground.share->own()});
    ground.share->set_halo(ground.hull->rows_met(&ground.safe, ground.share->own()));
    find_safe(halo_rows(*ground.share));
    ground.engine->take_tube_sets();
  }
  ground.allow = allow_table(ground.spec, abstraction, team, ground.listed ? &ground.listed->pairs : nullptr,
                             ground.shared_rows());
  if (ground.allow) ground.engine->set_allow(*ground.allow);
  ground.safe_cells = ground.count(ground.safe);
  ground.tiles = Tiles::find(*ground.engine, *ground.hull, ground.safe);
  look_for_like_agents(ground);
  ground.order.emplace(abstraction.grid);
}

std::vector<RankRows> rows_of_ranks(const Ground& ground, int ranks) {
  const UniformGrid& grid = ground.abstraction->grid;
  const CellSet unknown(grid.rows(), grid.row_length());
  TubeSets tubes;
  if (!ground.abstraction->tubes.empty()) tubes = {.inside = &unknown, .are_known = false};
  const RowEngine engine(*ground.abstraction, nullptr, tubes);
  const RowHull hull(engine);
  const std::vector<std::int64_t> bounds = cut_into_shares(ground.model, &engine, ranks);
  const std::vector<double> slices = bytes_of_slices(engine);
  std::vector<RankRows> result;
  for (std::size_t r = 0; r + 1 < bounds.size(); ++r) {
    const RowShare::Range own{bounds[r], bounds[r + 1]};
    std::vector<std::uint8_t> is_met = hull.rows_met(nullptr, own);
    std::fill(is_met.begin() + own.begin, is_met.begin() + own.end, std::uint8_t{0});
    RankRows& rows = result.emplace_back(
        RankRows{own.end - own.begin, std::count(is_met.begin(), is_met.end(), 1), slices});
    for (std::size_t t = 0; t < slices.size(); ++t) {
      if (ground.abstraction->tables[t].is_by_cells(grid.size()))
        rows.slices[t] *= static_cast<double>(rows.own) / static_cast<double>(grid.rows());
    }
  }
  return result;
}

}  // namespace coordreq
