#include "engine/sweep_order.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace coordreq {
namespace {

constexpr std::int64_t kJoinedRows = 32;  // of a batch of fronts that are joined, at most

/// Three states, rows along the last one; each moves by an offset of its own input.
Abstraction moving(const std::vector<std::int64_t>& counts,
                   const std::vector<std::vector<IndexRange>>& offsets) {
  std::vector<GridDimension> dimensions;
  std::vector<InputSpace::Dimension> inputs;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::string name(1, static_cast<char>('x' + i));
    dimensions.push_back({.name = name,
                          .first = 0,
                          .step = 1,
                          .count = counts[i],
                          .below = Outside::saturate,
                          .above = Outside::saturate,
                          .lower = 0,
                          .upper = counts[i]});
    std::vector<Rational> values;
    for (std::size_t u = 0; u < offsets[i].size(); ++u) values.emplace_back(static_cast<long>(u));
    inputs.push_back({"u" + name, values});
  }
  Abstraction abstraction{.grid = UniformGrid(dimensions), .inputs = InputSpace(inputs)};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    TransitionTable& table = abstraction.tables.emplace_back();
    table.states = {static_cast<std::int32_t>(i)};
    table.inputs = {static_cast<std::int32_t>(i)};
    table.shift = true;
    lay_out(table, i, abstraction.grid, abstraction.inputs);
    table.entries = offsets[i];
  }
  return abstraction;
}

/// Everything that an order follows from, with some rows alive.
struct OrderProblem {
  OrderProblem(const std::vector<std::int64_t>& counts, const std::vector<std::vector<IndexRange>>& offsets,
               const std::vector<bool>& alive_rows)
      : abstraction(moving(counts, offsets)),
        engine(abstraction, nullptr, {}),
        hull(engine),
        units(engine),
        levels(engine.make_levels<std::uint8_t>(engine.posts())) {
    for (std::int64_t r = 0; r < engine.rows(); ++r) {
      const bool is_alive = alive_rows[static_cast<std::size_t>(r) % alive_rows.size()];
      levels.change_row(r, [&](std::uint8_t* cells) { cells[0] = is_alive ? 255 : 0; });
    }
    alive.emplace(levels, RowShare::Range{0, engine.rows()}, units.rows(), false, nullptr, team);
  }
  [[nodiscard]] SweepOrder order(bool backwards, std::int64_t most_rows = INT32_MAX) const {
    return {units, hull, *alive, 0, units.count(), backwards, nullptr, most_rows};
  }

  ThreadTeam team{2};
  Abstraction abstraction;
  RowEngine engine;
  RowHull hull;
  RowUnits units;
  LevelRows<std::uint8_t> levels;
  std::optional<AliveRows> alive;
};

TEST(SweepOrder, EachUnitSeesWhatThoseBeforeItHaveFound) {
  EXPECT_TRUE(rc::check("as in ascending or descending order", [] {
    std::vector<std::int64_t> counts;
    std::vector<std::vector<IndexRange>> offsets;
    for (int i = 0; i < 3; ++i) {
      counts.push_back(*rc::gen::inRange<std::int64_t>(i < 2 ? 5 : 1, 14));
      const auto first = *rc::gen::inRange<std::int32_t>(-2, 3);
      offsets.push_back({{first, first}, {first, first + *rc::gen::inRange<std::int32_t>(0, 3)}});
    }
    const auto alive = *rc::gen::container<std::vector<bool>>(7, rc::gen::arbitrary<bool>());
    const OrderProblem problem(counts, offsets, alive);
    const bool backwards = *rc::gen::arbitrary<bool>();
    const SweepOrder order = problem.order(backwards, *rc::gen::element<std::int64_t>(1, 20, 1000));
    std::map<std::int64_t, std::size_t> batch_of;
    for (std::size_t b = 0; b < order.size(); ++b) {
      std::int64_t rows = 0;
      for (const std::uint32_t unit : order[b].units) {
        RC_ASSERT(batch_of.emplace(unit, b).second);
        rows += problem.alive->of_unit(unit);
      }
      RC_ASSERT(rows == order[b].rows);
    }
    RowPosition position = problem.units.first_position();
    std::vector<IndexRange> ranges;
    std::vector<std::int64_t> counter;
    for (std::int64_t unit = 0; unit < problem.units.count(); ++unit) {
      RC_ASSERT((problem.alive->of_unit(unit) > 0) == batch_of.contains(unit));
      if (!batch_of.contains(unit)) continue;
      problem.units.go_to(unit, position);
      problem.units.enclose(problem.hull, position, ranges);
      static_cast<void>(problem.units.any_in(ranges, counter, [&](std::int64_t other) {
        if ((backwards ? other <= unit : other >= unit) || !batch_of.contains(other)) return false;
        RC_ASSERT(batch_of[other] <= batch_of[unit]);
        if (batch_of[other] == batch_of[unit]) RC_ASSERT(order[batch_of[unit]].rows <= kJoinedRows);
        return false;
      }));
    }
  }));
}

TEST(SweepOrder, MotionOneWayIsOneBatchOneWayAndAsManyAsItIsLongTheOther) {
  const OrderProblem problem({20, 50, 9}, {{{1, 2}}, {{0, 0}}, {{0, 0}}}, {true});
  ASSERT_EQ(problem.units.count() * problem.units.rows(), 1000);
  EXPECT_EQ(problem.order(false).size(), 1);
  EXPECT_EQ(problem.order(true).size(), 20);
  EXPECT_EQ(problem.order(false, 100).size(), 10);
}

}  // namespace
}  // namespace coordreq
