#include "engine/level_map.hpp"

#include <array>
#include <optional>

#include "engine/different_rows.hpp"

namespace coordreq {
namespace {

template <class Level>
std::int64_t decoded(Level level) {
  return level == LevelRows<Level>::kTop ? LevelMap::kTop : static_cast<std::int64_t>(level);
}

/// counts[1 + level] += cells of some rows with that level, counts[0] += cells of the greatest level.
template <class Level>
void count_rows(const RowShape& shape, const DifferentRows<Level>& rows, ThreadTeam::Range range,
                std::vector<std::int64_t>& counts) {
  rows.for_each(range, [&](const Level* row, std::int64_t times) {
    shape.for_each_run([&](std::int64_t lane, std::int64_t count) {
      for (std::int64_t c = lane; c < lane + count; ++c) {
        const std::size_t level = row[c] == LevelRows<Level>::kTop ? 0 : std::size_t{row[c]} + 1;
        if (level >= counts.size()) counts.resize(level + 1, 0);
        counts[level] += times;
      }
    });
  });
}

/// For 8 bits counters have a fixed size; there are four a level, so that equal neighbours do not wait for
/// each other.
void count_rows(const RowShape& shape, const DifferentRows<std::uint8_t>& rows, ThreadTeam::Range range,
                std::vector<std::int64_t>& counts) {
  std::array<std::array<std::int64_t, 256>, 4> counters{};
  rows.for_each(range, [&](const std::uint8_t* row, std::int64_t times) {
    shape.for_each_run([&](std::int64_t lane, std::int64_t count) {
      const std::uint8_t* cells = row + lane;
      for (std::int64_t c = 0; c < count; ++c) counters[static_cast<std::size_t>(c % 4)][cells[c]] += times;
    });
  });
  counts.resize(256, 0);
  for (std::size_t level = 0; level < 256; ++level) {
    counts[(level + 1) % 256] +=
        counters[0][level] + counters[1][level] + counters[2][level] + counters[3][level];
  }
}

/// [1 + level] cells of that level, [0] cells never lost.
template <class Level>
std::vector<std::int64_t> count_levels(const LevelRows<Level>& levels, ThreadTeam& team) {
  constexpr std::int64_t kGrain = 1024;
  std::vector<std::vector<std::int64_t>> counts(static_cast<std::size_t>(team.size()));
  const DifferentRows<Level> rows(levels);
  team.for_each(rows.size(), kGrain, [&](ThreadTeam::Range range, int worker) {
    count_rows(levels.shape(), rows, range, counts[static_cast<std::size_t>(worker)]);
  });
  std::vector<std::int64_t> total(1, 0);
  for (const std::vector<std::int64_t>& one : counts) {
    if (one.size() > total.size()) total.resize(one.size(), 0);
    for (std::size_t k = 0; k < one.size(); ++k) total[k] += one[k];
  }
  if (levels.share() != nullptr) {
    Ranks& ranks = levels.share()->ranks();
    total.resize(static_cast<std::size_t>(ranks.greatest(static_cast<std::int64_t>(total.size()))), 0);
    ranks.add(total);
  }
  while (total.size() > 1 && total.back() == 0) total.pop_back();
  return total;
}

/// The lanes of a row that are cells; nothing if all are, as the row has no gaps.
std::optional<CellSet> cells_of_row(const RowShape& shape, std::int64_t row_length) {
  if (shape.dimensions.size() == 1) return std::nullopt;
  CellSet cells(1, row_length);
  shape.for_each_run(
      [&](std::int64_t lane, std::int64_t count) { set_bits(cells.row(0), lane, lane + count); });
  return cells;
}

}  // namespace

std::int64_t LevelMap::at(std::int64_t cell) const {
  return visit([cell](const auto& levels) {
    return decoded(levels.row(cell / levels.row_length())[cell % levels.row_length()]);
  });
}

LevelMap::Histogram LevelMap::histogram(ThreadTeam& team) const {
  const std::vector<std::int64_t> counts =
      visit([&](const auto& levels) { return count_levels(levels, team); });
  return {.finite = {counts.begin() + 1, counts.end()}, .top = counts[0]};
}

CellSet LevelMap::top_cells(ThreadTeam& team) const {
  CellSet result(rows(), row_length());
  visit([&]<class Level>(const LevelRows<Level>& levels) {
    const LevelKernels<Level>& kernels = level_kernels<Level>(best_instruction_set());
    const auto lanes = static_cast<std::size_t>(levels.row_length());
    const std::optional<CellSet> cells = cells_of_row(levels.shape(), levels.row_length());
    for_each_held_row(team, levels.share(), levels.rows(), 256, [&](ThreadTeam::Range range, int) {
      for (std::int64_t r = range.begin; r < range.end; ++r) {
        kernels.top_bits(levels.row(r), result.row(r).data(), lanes);
        for (std::size_t w = 0; cells && w < cells->words().size(); ++w)
          result.row(r)[w] &= cells->words()[w];
      }
    });
  });
  return result;
}

}  // namespace coordreq
