#include "answers/ground.hpp"

#include <algorithm>

#include "answers/invariance/safe_set.hpp"
#include "answers/invariance/safe_tubes.hpp"
#include "expression/evaluate.hpp"
#include "ranks/cut_rows.hpp"

namespace coordreq {
namespace {

/// Blocks of rows a rank between which it is cut: shares differ by a hundredth or so.
constexpr std::int64_t kBlocksOfRank = 64;
/// Rows of a block that are looked at.
constexpr std::int64_t kLooksAtBlock = 8;
/// Units a rank that are not cut: equal ones are found among whole ones only.
constexpr std::int64_t kUnitsOfRank = 8;

std::int64_t block_rows_of(const RowEngine& engine, int parts) {
  const std::int64_t rows = engine.rows(), most = kBlocksOfRank * parts, unit = engine.unit_rows();
  const std::int64_t block = (rows + most - 1) / most;
  return unit * kUnitsOfRank * parts <= rows ? (block + unit - 1) / unit * unit : block;
}

/// Tells rows in which S has no cell, by intervals around the centres of a row; not all of them.
class SafeRows {
 public:
  SafeRows(const ProblemSpec& spec, const UniformGrid& grid)
      : grid_(grid), safe_(spec.safe), box_(spec.slot_count()) {
    for (std::size_t i = grid.across(); i < grid.size(); ++i)
      box_[grid.state(i)] = enclose(grid[i].point(0), grid[i].point(grid[i].count - 1));
  }

  [[nodiscard]] bool may_hold(std::int64_t row) {
    const RowPlace place(grid_, row);
    for (std::size_t i = 0; i < grid_.across(); ++i)
      box_[grid_.state(i)] = enclose(grid_[i].point(place.index[i]));
    return safe_.condition(box_) != Truth::no;
  }

 private:
  const UniformGrid& grid_;
  Evaluator<Interval> safe_;
  std::vector<Interval> box_;  ///< by slot
};

/// Cuts the rows into runs with about as many in which S may have cells, as some rows of each block tell; of
/// whole units, if these are not too large.
std::vector<std::int64_t> cut_by_safe_rows(const ProblemSpec& spec, const RowEngine& engine, int parts) {
  const std::int64_t rows = engine.rows(), block = block_rows_of(engine, parts);
  SafeRows safe_rows(spec, engine.grid());
  std::vector<std::int64_t> weights;
  for (std::int64_t begin = 0; begin < rows; begin += block) {
    const std::int64_t own = std::min(block, rows - begin), looks = std::min(own, kLooksAtBlock);
    std::int64_t safe = 0;
    for (std::int64_t look = 0; look < looks; ++look)
      safe += safe_rows.may_hold((2 * look + 1) * own / (2 * looks) + begin) ? 1 : 0;
    weights.push_back(safe * own / looks);
  }
  return cut_rows(weights, block, rows, parts);
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
  const auto find_safe = [&](const std::vector<RowShare::Range>& runs) {
    add_cells_that_satisfy(ground.spec.safe, ground.spec, abstraction.grid, abstraction.inputs, runs, team,
                           ground.safe);
  };
  ground.safe = CellSet(rows, abstraction.grid.row_length());
  // Tubes meet other rows than posts.
  const bool is_whole = ground.ranks == nullptr || !abstraction.tubes.empty();
  if (is_whole) find_safe({{0, rows}});
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
    *ground.share = {*ground.ranks, cut_by_safe_rows(ground.spec, *ground.engine, ground.ranks->count())};
    if (!is_whole) find_safe({ground.share->own()});
    ground.share->set_halo(ground.hull->rows_met(&ground.safe, ground.share->own()));
    if (!is_whole) find_safe(halo_rows(*ground.share));
  }
  ground.safe_cells = ground.count(ground.safe);
  ground.tiles = Tiles::find(*ground.engine, *ground.hull, ground.safe);
  ground.order.emplace(abstraction.grid);
}

std::vector<RankRows> rows_of_ranks(const Ground& ground, int ranks) {
  const RowEngine engine(*ground.abstraction, nullptr, {});
  const RowHull hull(engine);
  const std::vector<std::int64_t> bounds = cut_by_safe_rows(ground.spec, engine, ranks);
  std::vector<RankRows> result;
  for (std::size_t r = 0; r + 1 < bounds.size(); ++r) {
    const RowShare::Range own{bounds[r], bounds[r + 1]};
    std::vector<std::uint8_t> is_met = hull.rows_met(nullptr, own);
    std::fill(is_met.begin() + own.begin, is_met.begin() + own.end, std::uint8_t{0});
    result.push_back({own.end - own.begin, std::count(is_met.begin(), is_met.end(), 1)});
  }
  return result;
}

}  // namespace coordreq
