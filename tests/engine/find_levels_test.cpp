#include "engine/find_levels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <vector>

namespace coordreq {
namespace {

/// An operator that returns at once the final level less one of every cell; the greatest level where `wanted`
/// is negative.
template <class Level>
class KnownLevels final : public RowOperator<Level> {
 public:
  explicit KnownLevels(const std::vector<std::int64_t>& wanted) : wanted_(wanted) {}

  bool next_levels(const RowPosition& position, PostReader<Level>& posts, const Level* /*old*/, Level* next,
                   int /*worker*/) override {
    constexpr Level kTop = PostReader<Level>::kTop;
    const auto n = static_cast<std::int64_t>(posts.lanes() - kLevelBlock / sizeof(Level));
    for (std::int64_t c = 0; c < n; ++c) {
      const std::int64_t level = wanted_[static_cast<std::size_t>(position.row * n + c)] - 1;
      next[c] = level < 0 || level >= kTop ? kTop : static_cast<Level>(level);
    }
    return true;
  }

 private:
  const std::vector<std::int64_t>& wanted_;
};

/// States that stay where they are.
Abstraction stillness(std::int64_t rows, std::int64_t row_length) {
  std::vector<GridDimension> dimensions;
  for (const std::int64_t count : {rows, row_length})
    dimensions.push_back({.name = "x", .first = 0, .step = 1, .count = count});
  Abstraction abstraction{.grid = UniformGrid(dimensions), .inputs = InputSpace({})};
  for (std::size_t i = 0; i < 2; ++i) {
    TransitionTable& table = abstraction.tables.emplace_back();
    table.states = {static_cast<std::int32_t>(i)};
    table.shift = true;
    table.entries.resize(static_cast<std::size_t>(lay_out(table, i, abstraction.grid, abstraction.inputs)));
  }
  return abstraction;
}

/// Finds levels 1, 2, ..., `most` and one cell without, in rows of 64 cells, the rest outside of the first
/// set.
void expect_levels(std::int64_t most, std::int64_t limit, int threads) {
  const Abstraction abstraction = stillness(most / 64 + 1, 64);
  const RowEngine engine(abstraction, nullptr, {});
  const RowHull hull(engine);
  CellSet start(abstraction.grid.rows(), 64);
  std::vector<std::int64_t> wanted(static_cast<std::size_t>(start.cells()), -1);
  for (std::int64_t x = 0; x <= most; ++x) {
    start.set(x);
    wanted[static_cast<std::size_t>(x)] = x < most ? x + 1 : -1;
  }
  const LevelProblem problem{.start = &start,
                             .limit = limit,
                             .make8 = [&] { return std::make_unique<KnownLevels<std::uint8_t>>(wanted); },
                             .make16 = [&] { return std::make_unique<KnownLevels<std::uint16_t>>(wanted); },
                             .make32 = [&] { return std::make_unique<KnownLevels<std::uint32_t>>(wanted); }};
  ThreadTeam team(threads);
  WaveCounts counts;
  const LevelMap levels = find_levels(engine, hull, problem, {}, team, counts);
  std::int64_t wrong = 0;
  for (std::int64_t x = 0; x < start.cells(); ++x) {
    const bool is_finite = x < most && (limit < 0 || x + 1 <= limit);
    const std::int64_t expected = x > most ? 0 : is_finite ? x + 1 : LevelMap::kTop;
    wrong += levels.at(x) == expected ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0) << "most " << most << ", limit " << limit << ", " << threads << " threads";
  const auto histogram = levels.histogram(team);
  const std::int64_t greatest = limit < 0 ? most : std::min(most, limit);
  EXPECT_EQ(histogram.finite.size(), static_cast<std::size_t>(greatest) + 1);
  EXPECT_EQ(histogram.finite.back(), greatest == 0 ? start.cells() - most - 1 : 1);
  EXPECT_EQ(histogram.top, most + 1 - greatest);
  EXPECT_EQ(levels.top_cells(team).count(), histogram.top);
}

TEST(FindLevels, OfAnyNumberAroundTheEndsOfEightAndSixteenBits) {
  for (const std::int64_t most : {0, 1, 253, 254, 255, 256, 300, 65533, 65534, 65535, 65536, 70000})
    expect_levels(most, -1, 1);
}

TEST(FindLevels, AboveTheLimitCountAsNeverLost) {
  for (const std::int64_t limit : {0, 1, 7, 253, 254, 255, 256, 299, 300, 301}) expect_levels(300, limit, 1);
  for (const std::int64_t limit : {254, 65533, 65534, 65535, 65536, 70000}) expect_levels(65540, limit, 1);
}

TEST(FindLevels, WithAnyNumberOfThreads) {
  for (const int threads : {2, 5}) {
    expect_levels(300, -1, threads);
    expect_levels(66000, -1, threads);
    expect_levels(66000, 65535, threads);
  }
}

/// All cells of a row move on by so many along it.
constexpr std::int32_t kAhead = 100;

class MoveOn final : public RowOperator<std::uint8_t> {
 public:
  explicit MoveOn(std::atomic<int>& parts) : parts_(parts) {}

  bool next_levels(const RowPosition& position, PostReader<std::uint8_t>& posts, const std::uint8_t* old,
                   std::uint8_t* next, int /*worker*/) override {
    const std::size_t n = posts.lanes() - kLevelBlock;
    if (std::count(old, old + n, 0) > 0) ++parts_;
    RowBox box;
    const auto row = static_cast<std::int32_t>(position.row);
    box.ranges.assign(1, {row, row});
    box.windows.assign(1, {kAhead, kAhead});
    std::copy_n(posts.minimum(box), n, next);
    return true;
  }

 private:
  std::atomic<int>& parts_;  ///< calls for some of the lanes
};

TEST(FindLevels, OfALongRowWhoseLanesThreadsDivide) {
  constexpr std::int64_t kLength = 10'007;
  Abstraction abstraction = stillness(2, kLength);
  abstraction.tables[1].entries.assign(1, {kAhead, kAhead});
  const RowEngine engine(abstraction, nullptr, {});
  const RowHull hull(engine);
  CellSet start(2, kLength);
  for (std::int64_t x = 0; x < kLength; ++x) start.set(x);
  for (const int threads : {1, 2, 7}) {
    std::atomic<int> parts = 0;
    const LevelProblem problem{.start = &start, .make8 = [&] { return std::make_unique<MoveOn>(parts); }};
    ThreadTeam team(threads);
    WaveCounts counts;
    const LevelMap levels = find_levels(engine, hull, problem, {}, team, counts);
    EXPECT_EQ(parts > 0, threads > 1);
    EXPECT_EQ(counts.rows_visited, (kLength + kAhead - 1) / kAhead + 1);
    std::int64_t wrong = 0;
    for (std::int64_t x = 0; x < kLength; ++x)
      wrong += levels.at(x) == (kLength - x + kAhead - 1) / kAhead ? 0 : 1;
    EXPECT_EQ(wrong, 0) << threads << " threads";
  }
}

}  // namespace
}  // namespace coordreq
