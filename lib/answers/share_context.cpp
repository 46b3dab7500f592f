#include "answers/share_context.hpp"

#include <algorithm>

#include "answers/row_cut.hpp"
#include "engine/engine_sizes.hpp"

namespace coordreq {

RowShare nothing_owned(Ranks& ranks) {
  return {ranks, std::vector<std::int64_t>(1 + static_cast<std::size_t>(ranks.count()), 0)};
}

void share_context(AnalysisContext& context, bool is_cut,
                   const std::function<void(const std::vector<RowShare::Range>&)>& find_safe) {
  RowShare& share = *context.share;
  if (!is_cut)
    share = {*context.ranks, cut_into_shares(context.model, &*context.engine, context.ranks->count())};
  find_safe({share.local()});
  share.set_ghosts(context.hull->rows_reached(&context.safe, share.local()));
  find_safe(ghost_rows(share));
  context.engine->take_tube_sets();
}

std::vector<RankRows> rows_of_ranks(const AnalysisContext& context, int ranks) {
  const UniformGrid& grid = context.abstraction->grid;
  const CellSet unknown(grid.rows(), grid.row_length());
  TubeSets tubes;
  if (!context.abstraction->tubes.empty()) tubes = {.inside = &unknown, .are_known = false};
  const RowEngine engine(*context.abstraction, nullptr, tubes);
  const RowHull hull(engine);
  const std::vector<std::int64_t> bounds = cut_into_shares(context.model, &engine, ranks);
  const std::vector<double> slices = bytes_of_slices(engine);
  std::vector<RankRows> result;
  for (std::size_t r = 0; r + 1 < bounds.size(); ++r) {
    const RowShare::Range local{bounds[r], bounds[r + 1]};
    std::vector<std::uint8_t> is_needed = hull.rows_reached(nullptr, local);
    std::fill(is_needed.begin() + local.begin, is_needed.begin() + local.end, std::uint8_t{0});
    RankRows& rows = result.emplace_back(
        RankRows{local.end - local.begin, std::count(is_needed.begin(), is_needed.end(), 1), slices});
    for (std::size_t t = 0; t < slices.size(); ++t) {
      if (context.abstraction->tables[t].is_by_cells(grid.size()))
        rows.slices[t] *= static_cast<double>(rows.owned) / static_cast<double>(grid.rows());
    }
  }
  return result;
}

}  // namespace coordreq
