#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "model/condition_table.hpp"
#include "model/pieces.hpp"
#include "support/condition_helpers.hpp"
#include "support/random_condition.hpp"

namespace coordreq {
namespace {

GridDimension random_state(const char* name) {
  const int count = test::draw(1, 5);
  const bool ring = test::draw(0, 2) == 0;
  GridDimension state{.name = name, .first = test::draw(-1, 2), .step = test::draw(0, 1) == 0 ? 1 : 2};
  state.count = count;
  state.below = state.above = ring ? Outside::periodic : Outside::unsafe;
  state.lower = state.first;
  state.upper = state.first + state.step * Rational(count);
  state.discrete = test::draw(0, 4) == 0;
  if (test::draw(0, 3) == 0) state.measurement_error = Rational(1) / 4;
  return state;
}

/// Everything that x, y and z can be in one case of the table: a box for each choice of pieces.
std::vector<test::Box> boxes(const UniformGrid& grid, const Rational& input, std::int64_t x, std::int64_t y,
                             Sampling sampling) {
  const auto choices = [&](std::size_t i, std::int64_t k) {
    if (sampling == Sampling::centres) return std::vector<Piece>{{grid[i].point(k), grid[i].point(k)}};
    return pieces(grid[i], k);
  };
  std::vector<test::Box> result;
  for (const Piece& a : choices(0, x)) {
    for (const Piece& b : choices(1, y)) {
      result.push_back(
          {test::between(a.lower, a.upper), test::between(b.lower, b.upper), test::between(input, input)});
    }
  }
  return result;
}

/// Each case decided by itself, the condition as one.
Truth decide_alone(const Program& condition, const std::vector<test::Box>& parts) {
  Truth truth = test::decide(condition, parts[0]);
  for (const test::Box& part : parts) {
    if (test::decide(condition, part) != truth) truth = Truth::undecided;
  }
  return truth;
}

bool holds_at_corners(const Program& condition, const std::vector<test::Box>& parts) {
  for (const test::Box& part : parts) {
    for (unsigned corner = 0; corner < 8; ++corner) {
      test::Box point;
      for (std::size_t i = 0; i < 3; ++i) {
        const Rational& value = (corner >> i & 1U) != 0 ? part[i].upper : part[i].lower;
        point.push_back(test::between(value, value));
      }
      if (test::decide_naturally(condition, point) != Truth::yes) return false;
    }
  }
  return true;
}

/// x and y are states, z is an input, as in `allow`. Comparisons settle cases together; that must not change
/// what is decided case by case, only add to it, and nothing that is not true.
TEST(ConditionTable, ComparisonsSettleTheSameCasesAsTheWhole) {
  EXPECT_TRUE(rc::check("tabulated against case by case", [] {
    const std::string text = test::random_condition(2);
    const Program condition = test::condition(text);
    const UniformGrid grid({random_state("x"), random_state("y")});
    const InputSpace inputs({{"z", {Rational(-1), Rational(1) / 2, Rational(2)}}});
    const Sampling sampling = test::draw(0, 1) == 0 ? Sampling::centres : Sampling::closed_cells;
    ThreadTeam team(1);
    std::vector<std::vector<std::int64_t>> open;
    const auto undecided = [&](const std::vector<std::int64_t>& indices) {
      open.push_back(indices);
      return false;
    };
    const ConditionTable table(condition, grid, inputs, sampling, undecided, team);
    RC_TAG(sampling == Sampling::centres ? "centres" : "cells");
    bool more = false;
    for (std::int64_t cell = 0; cell < grid.cells(); ++cell) {
      for (std::int64_t u = 0; u < inputs.count(); ++u) {
        const std::int64_t x = grid.index(cell, 0);
        const std::int64_t y = grid.index(cell, 1);
        const auto parts = boxes(grid, inputs[0].values[static_cast<std::size_t>(u)], x, y, sampling);
        const std::span<const TruthTable::Word> row = table.row(x, u);
        const bool set = (row[0] >> y & 1U) != 0;
        const Truth alone = decide_alone(condition, parts);
        RC_ASSERT(set || alone != Truth::yes);
        RC_ASSERT(!set || alone != Truth::no);
        RC_ASSERT(!set || holds_at_corners(condition, parts));
        RC_ASSERT(!set || sampling == Sampling::closed_cells || alone == Truth::yes);
        more = more || (set && alone == Truth::undecided);
      }
    }
    RC_CLASSIFY(more, "comparisons prove more than the whole");
    // Only what is open after both is asked for.
    for (const auto& indices : open) {
      const std::size_t u = table.positions().inputs.empty() ? 0 : static_cast<std::size_t>(indices[2]);
      const bool in_use = table.positions().state_stride[0] != 0;
      const auto parts = boxes(grid, inputs[0].values[u], in_use ? indices[0] : 0, indices[1], sampling);
      RC_ASSERT(decide_alone(condition, parts) == Truth::undecided);
    }
  }));
}

}  // namespace
}  // namespace coordreq
