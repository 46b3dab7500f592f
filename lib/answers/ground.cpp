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

/// Cuts the rows into runs with about as many in which S has cells; of whole units, if these are not too
/// large.
class SafeRows {
 public:
  SafeRows(const RowEngine& engine, const CellCondition& condition, int parts, ThreadTeam& team)
      : engine_(engine), condition_(condition), parts_(parts), team_(team) {
    const std::int64_t rows = engine.rows(), most = kBlocksOfRank * parts, unit = engine.unit_rows();
    block_rows_ = (rows + most - 1) / most;
    if (unit * kUnitsOfRank * parts <= rows) block_rows_ = (block_rows_ + unit - 1) / unit * unit;
    weights.assign(static_cast<std::size_t>((rows + block_rows_ - 1) / block_rows_), 0);
    even_ = cut();
  }

  /// Each weighs as many.
  void weigh(int part) {
    const std::int64_t begin = even_[static_cast<std::size_t>(part)];
    const std::int64_t end = even_[static_cast<std::size_t>(part) + 1];
    CellSet safe(engine_.rows(), engine_.row_length());
    condition_.add_cells({{begin, end}}, team_, safe);
    for (std::int64_t r = begin; r < end; ++r)
      weights[static_cast<std::size_t>(r / block_rows_)] += any_set(safe.row(r)) ? 1 : 0;
  }
  [[nodiscard]] std::vector<std::int64_t> cut() const {
    return cut_rows(weights, block_rows_, engine_.rows(), parts_);
  }

  std::vector<std::int64_t> weights;  ///< of blocks of rows

 private:
  const RowEngine& engine_;
  const CellCondition& condition_;
  int parts_;
  ThreadTeam& team_;
  std::int64_t block_rows_ = 1;
  std::vector<std::int64_t> even_;
};

RowShare cut_by_safe_rows(Ranks& ranks, const RowEngine& engine, const CellCondition& condition,
                          ThreadTeam& team) {
  SafeRows safe(engine, condition, ranks.count(), team);
  safe.weigh(ranks.rank());
  ranks.add(safe.weights);
  return {ranks, safe.cut()};
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

std::vector<RankRows> rows_of_ranks(const Ground& ground, int ranks, ThreadTeam& team) {
  const Abstraction& abstraction = *ground.abstraction;
  const CellCondition condition(ground.spec.safe, ground.spec, abstraction.grid, abstraction.inputs, team);
  const RowEngine engine(abstraction, nullptr, {});
  const RowHull hull(engine);
  SafeRows rows(engine, condition, ranks, team);
  for (int r = 0; r < ranks; ++r) rows.weigh(r);
  const std::vector<std::int64_t> bounds = rows.cut();
  std::vector<RankRows> result;
  for (std::size_t r = 0; r + 1 < bounds.size(); ++r) {
    const RowShare::Range own{bounds[r], bounds[r + 1]};
    CellSet safe(engine.rows(), engine.row_length());
    condition.add_cells({own}, team, safe);
    std::vector<std::uint8_t> is_met = hull.rows_met(safe, own);
    std::fill(is_met.begin() + own.begin, is_met.begin() + own.end, std::uint8_t{0});
    result.push_back({own.end - own.begin, std::count(is_met.begin(), is_met.end(), 1)});
  }
  return result;
}

}  // namespace coordreq
