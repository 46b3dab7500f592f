#include "model/condition_table.hpp"

#include <gtest/gtest.h>

#include "support/condition_helpers.hpp"

namespace coordreq {
namespace {

/// [1, 5), points 1, 2, 3, 4.
GridDimension ring() {
  return {.name = "x",
          .first = 1,
          .step = 1,
          .count = 4,
          .below = Outside::periodic,
          .above = Outside::periodic,
          .lower = 1,
          .upper = 5};
}

/// "1" where the condition holds on the cell, "?" where the callback was asked.
std::string table(const char* text, const GridDimension& dimension, Sampling sampling) {
  const Program program = test::condition(text);
  const UniformGrid grid({dimension});
  const InputSpace inputs({});
  ThreadTeam team(1);
  std::string result(static_cast<std::size_t>(dimension.count), '.');
  const auto undecided = [&](const std::vector<std::int64_t>& indices) {
    result[static_cast<std::size_t>(indices[0])] = '?';
    return false;
  };
  const ConditionTable conditions(program, grid, inputs, sampling, undecided, team);
  for (std::int64_t k = 0; k < dimension.count; ++k) {
    if ((conditions.row(0, 0)[0] >> k & 1U) != 0) result[static_cast<std::size_t>(k)] = '1';
  }
  return result;
}

TEST(ConditionTable, ACellOnTheSeamCountsWithBothPieces) {
  EXPECT_EQ(table("x <= 1.5 or x >= 4.5", ring(), Sampling::closed_cells), "1?.?");
  EXPECT_EQ(table("x <= 1.5 or x >= 4", ring(), Sampling::closed_cells), "1?.?");
  EXPECT_EQ(table("x < 3", ring(), Sampling::closed_cells), "?1?.");
  EXPECT_EQ(table("x > 1.75 and x < 4.25", ring(), Sampling::closed_cells), ".?1?");
}

TEST(ConditionTable, CentresKnowNoSeam) {
  EXPECT_EQ(table("x < 3", ring(), Sampling::centres), "11..");
}

TEST(ConditionTable, CellsAreWidenedByTheMeasurementError) {
  GridDimension line{.name = "x", .first = 0, .step = 1, .count = 5};
  EXPECT_EQ(table("x <= 2.5", line, Sampling::closed_cells), "111?.");
  line.measurement_error = Rational(1, 4);
  EXPECT_EQ(table("x <= 2.5", line, Sampling::closed_cells), "11??.");
  EXPECT_EQ(table("x <= 2.5", line, Sampling::centres), "111..");
  GridDimension heading = ring();
  heading.measurement_error = Rational(1, 2);
  // Cell 3 reaches the seam, whose point is seen as 1.
  EXPECT_EQ(table("x >= 1.5", heading, Sampling::closed_cells), "??1?");
}

TEST(ConditionTable, NumbersVariablesAsTheSpecWhateverTheOrderOfTheGrid) {
  GridDimension x{.name = "x", .first = 0, .step = 1, .count = 3};
  GridDimension y{.name = "y", .first = 0, .step = 1, .count = 4};
  const UniformGrid grid({x, y});
  const UniformGrid turned = grid.arranged({1, 0});
  const InputSpace inputs({});
  const Program condition = test::condition("x > y");
  const auto undecided = [](const std::vector<std::int64_t>&) { return false; };
  ThreadTeam team(1);
  const ConditionTable natural(condition, grid, inputs, Sampling::centres, undecided, team);
  const ConditionTable other(condition, turned, inputs, Sampling::centres, undecided, team);
  for (std::int64_t i = 0; i < 3; ++i) {
    for (std::int64_t j = 0; j < 4; ++j) {
      EXPECT_EQ(natural.row(i, 0)[0] >> j & 1U, i > j ? 1U : 0U);
      EXPECT_EQ(other.row(j, 0)[0] >> i & 1U, i > j ? 1U : 0U);
    }
  }
}

TEST(ConditionTable, SomeLeadingIndicesGiveTheSameRows) {
  const GridDimension y{.name = "y", .first = 0, .step = 1, .count = 6};
  const GridDimension z{.name = "z", .first = 0, .step = 1, .count = 4};
  const UniformGrid grid({ring(), y, z});
  const InputSpace inputs({});
  const auto undecided = [](const std::vector<std::int64_t>&) { return false; };
  ThreadTeam team(1);
  const auto table_of = [&](const Program& condition, std::optional<ThreadTeam::Range> leading) {
    return ConditionTable(condition, grid, inputs, Sampling::closed_cells, undecided, team,
                          Question::everywhere, leading);
  };
  for (const char* text : {"x + z < y", "x < 2 and y > 1", "y >= 2", "true"}) {
    const Program condition = test::condition(text);
    const ConditionTable whole = table_of(condition, std::nullopt);
    const ConditionTable some = table_of(condition, ThreadTeam::Range{1, 3});
    for (std::int64_t row = 6; row < 18; ++row) EXPECT_EQ(some.row(row, 0)[0], whole.row(row, 0)[0]) << text;
  }
}

}  // namespace
}  // namespace coordreq
