#include "answers/ground.hpp"

#include <algorithm>

#include "answers/invariance/safe_set.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "ranks/cut_rows.hpp"

namespace coordreq {
namespace {

/// Blocks of rows a rank that are weighed: shares differ by a hundredth or so.
constexpr std::int64_t kBlocksOfRank = 64;
/// Units a rank that are not cut: equal ones are found among whole ones only.
constexpr std::int64_t kUnitsOfRank = 8;

/// Runs of rows with about as many rows in which S has cells; of whole units, if these are not too large.
RowShare cut_by_safe_rows(Ranks& ranks, const RowEngine& engine, const CellCondition& condition,
                          ThreadTeam& team) {
  const std::int64_t rows = engine.rows();
  const std::int64_t most = kBlocksOfRank * ranks.count();
  std::int64_t block_rows = (rows + most - 1) / most;
  const std::int64_t unit = engine.unit_rows();
  if (unit * kUnitsOfRank * ranks.count() <= rows) block_rows = (block_rows + unit - 1) / unit * unit;
  std::vector<std::int64_t> weights(static_cast<std::size_t>((rows + block_rows - 1) / block_rows), 0);
  // Each looks at as many.
  const RowShare even(ranks, cut_rows(weights, block_rows, rows, ranks.count()));
  CellSet safe(rows, engine.row_length());
  condition.add_cells({even.own()}, team, safe);
  for (std::int64_t r = even.own().begin; r < even.own().end; ++r)
    weights[static_cast<std::size_t>(r / block_rows)] += any_set(safe.row(r)) ? 1 : 0;
  ranks.add(weights);
  return {ranks, cut_rows(weights, block_rows, rows, ranks.count())};
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

void lay_ground(Ground& ground, ThreadTeam& team) {
  const Abstraction& abstraction = *ground.abstraction;
  const std::int64_t rows = abstraction.grid.rows();
  const CellCondition condition(ground.spec.safe, ground.spec, abstraction.grid, abstraction.inputs, team);
  ground.safe = CellSet(rows, abstraction.grid.row_length());
  // Tubes meet other rows than posts.
  const bool is_whole = ground.ranks == nullptr || !abstraction.tubes.empty();
  if (is_whole) condition.add_cells({{0, rows}}, team, ground.safe);
  ground.allow = allow_table(ground.spec, abstraction, team, ground.listed ? &ground.listed->pairs : nullptr);
  ground.beyond = safe_beyond_limits(ground.spec, abstraction, ground.safe, team);
  // How it is cut depends on the engine, which only has to know that it is.
  if (ground.ranks != nullptr)
    ground.share.emplace(*ground.ranks,
                         std::vector<std::int64_t>(1 + static_cast<std::size_t>(ground.ranks->count()), 0));
  ground.engine.emplace(abstraction, ground.allow ? &*ground.allow : nullptr, ground.tubes(),
                        ground.shared_rows());
  ground.hull.emplace(*ground.engine);
  if (ground.ranks != nullptr) {
    *ground.share = cut_by_safe_rows(*ground.ranks, *ground.engine, condition, team);
    condition.add_cells({ground.share->own()}, team, ground.safe);
    ground.share->set_halo(ground.hull->rows_met(ground.safe, ground.share->own()));
    condition.add_cells(ground.share->held(), team, ground.safe);
  }
  ground.safe_cells = ground.count(ground.safe);
  ground.tiles = Tiles::find(*ground.engine, *ground.hull, ground.safe);
  ground.order.emplace(abstraction.grid);
}

}  // namespace coordreq
