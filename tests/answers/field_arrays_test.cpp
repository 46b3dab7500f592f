#include "answers/field_arrays.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

UniformGrid grid(std::vector<std::int64_t> counts) {
  std::vector<GridDimension> dimensions;
  for (const std::int64_t count : counts) {
    dimensions.push_back({.name = "x", .first = 0, .step = 1, .count = count});
  }
  return UniformGrid(std::move(dimensions));
}

constexpr int kTop = 255;

/// Rows of the engine, with margins.
LevelMap levels(std::int64_t row_length, const std::vector<int>& values) {
  LevelRows<std::uint8_t> rows(static_cast<std::int64_t>(values.size()) / row_length, row_length, {1, 3}, {});
  for (std::size_t x = 0; x < values.size(); ++x) {
    const auto cell = static_cast<std::int64_t>(x);
    rows.change_row(cell / row_length, [&](std::uint8_t* row) {
      row[cell % row_length] = static_cast<std::uint8_t>(values[x]);
    });
  }
  return LevelMap(std::move(rows));
}

template <class Integer>
std::vector<Integer> filled(const ResultArray& array, std::uint64_t begin, std::uint64_t count) {
  std::vector<Integer> out(count, Integer{99});
  array.fill(begin, count, out.data());
  return out;
}

TEST(FieldArrays, SmallLevelsAreStoredInSixteenBits) {
  EXPECT_EQ(level_type(32766), ElementType::int16);
  EXPECT_EQ(level_type(32767), ElementType::int32);
  EXPECT_EQ(level_type(-1), ElementType::int16);
}

TEST(FieldArrays, CollisionTimesTellSAndKToo) {
  const LevelMap times = levels(3, {0, 1, kTop, 7, kTop, 0});
  const CellOrder order(grid({2, 3}));
  EXPECT_EQ(filled<std::int16_t>(collision_array(times, order, ElementType::int16), 1, 4),
            (std::vector<std::int16_t>{1, 32767, 7, 32767}));
  EXPECT_EQ(filled<std::int32_t>(collision_array(times, order, ElementType::int32), 0, 6),
            (std::vector<std::int32_t>{0, 1, INT32_MAX, 7, INT32_MAX, 0}));
  EXPECT_EQ(filled<std::uint8_t>(safe_array(times, order), 0, 6),
            (std::vector<std::uint8_t>{0, 1, 1, 1, 1, 0}));
  EXPECT_EQ(filled<std::uint8_t>(invariant_array(times, order), 2, 3), (std::vector<std::uint8_t>{1, 0, 1}));
}

TEST(FieldArrays, DelaysAndTriggersOfEveryKindOfCell) {
  const LevelMap times = levels(6, {0, 2, kTop, kTop, kTop, kTop});
  DelayLayers layers{.layers_of = levels(6, {0, 0, 1, 2, 6, kTop}), .sizes = {4, 3, 2, 2, 2, 2, 1}};
  const CellOrder order(grid({6}));
  EXPECT_EQ(filled<std::int16_t>(delay_array(layers, times, order, ElementType::int16), 0, 6),
            (std::vector<std::int16_t>{-2, -1, 0, 1, 5, 32767}));
  EXPECT_EQ(filled<std::int16_t>(trigger_array(layers, times, 2, order, ElementType::int16), 0, 6),
            (std::vector<std::int16_t>{-2, -1, -3, -3, 3, 32767}));
  layers.truncated = true;  // after six steps
  EXPECT_EQ(filled<std::int32_t>(delay_array(layers, times, order, ElementType::int32), 0, 6),
            (std::vector<std::int32_t>{-2, -1, 0, 1, 5, 6}));
  EXPECT_EQ(filled<std::int32_t>(trigger_array(layers, times, 2, order, ElementType::int32), 4, 2),
            (std::vector<std::int32_t>{3, 4}));
}

TEST(FieldArrays, LayersListTheirCellsInAscendingOrder) {
  const DelayLayers layers{.layers_of = levels(7, {2, 0, 1, kTop, 2, 0, 1}), .sizes = {5, 3, 1}};
  const CellOrder order(grid({7}));
  EXPECT_EQ(layer_starts(layers), (std::vector<std::uint64_t>{0, 2, 4, 5}));
  const auto cache = std::make_shared<CellsCache>();
  const ResultArray cells = layer_cells(layers, order, cache);
  EXPECT_EQ(cells.type, ElementType::uint32);
  EXPECT_EQ(filled<std::uint32_t>(cells, 0, 5), (std::vector<std::uint32_t>{2, 6, 0, 4, 3}));
  const DelayLayers others{.layers_of = levels(7, {0, 1, 0, 0, kTop, 0, 0}), .sizes = {2, 1}};
  EXPECT_EQ(filled<std::uint32_t>(layer_cells(others, order, cache), 0, 2),
            (std::vector<std::uint32_t>{1, 4}));
  EXPECT_EQ(filled<std::uint32_t>(cells, 3, 2), (std::vector<std::uint32_t>{4, 3}));
}

TEST(FieldArrays, CellsComeInTheOrderOfTheSpec) {
  // The spec's (a, b, c) with 2, 3 and 2 points are the engine's (b, c, a).
  const UniformGrid engine = grid({2, 3, 2}).arranged({1, 2, 0});
  const CellOrder order(engine);
  std::vector<int> values;
  std::vector<std::int16_t> expected(12);
  for (int b = 0; b < 3; ++b) {
    for (int c = 0; c < 2; ++c) {
      for (int a = 0; a < 2; ++a) {
        values.push_back(100 * a + 10 * b + c);
        expected[static_cast<std::size_t>((a * 3 + b) * 2 + c)] = static_cast<std::int16_t>(values.back());
      }
    }
  }
  const LevelMap times = levels(2, values);
  const ResultArray array = collision_array(times, order, ElementType::int16);
  for (std::uint64_t begin = 0; begin < 12; ++begin) {
    for (std::uint64_t count = 1; begin + count <= 12; ++count) {
      const auto from = expected.begin() + static_cast<std::ptrdiff_t>(begin);
      EXPECT_EQ(filled<std::int16_t>(array, begin, count),
                std::vector<std::int16_t>(from, from + static_cast<std::ptrdiff_t>(count)));
    }
  }
}

}  // namespace
}  // namespace coordreq
