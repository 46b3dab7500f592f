#include "reach/taylor_kernels.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <vector>

#include "numeric/random_doubles.hpp"
#include "reach/ball.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kOrders = 8;

/// A made-up tape: states, fixed nodes, and a node of each kind of them.
struct Tape {
  std::vector<SeriesNode> nodes;
  std::vector<SeriesOutput> outputs;
  std::uint32_t size = 0;
};

Tape some_tape() {
  Tape tape;
  const auto add = [&](SeriesNode node) {
    node.self = tape.size++;
    tape.nodes.push_back(node);
    return node.self;
  };
  const std::uint32_t fixed = tape.size++;
  const std::uint32_t x = add({.step = SeriesStep::input, .weighted = true, .p = 0});
  const std::uint32_t y = add({.step = SeriesStep::input, .weighted = true, .p = 1});
  const auto binary = [&](SeriesStep step, std::uint32_t p, std::uint32_t q, std::uint32_t square = 0) {
    return add({.step = step,
                .p_moves = p != fixed,
                .q_moves = q != fixed,
                .square_moves = square != fixed,
                .weighted = true,
                .p = p,
                .q = q,
                .square = square});
  };
  const std::uint32_t sum = binary(SeriesStep::sum, x, fixed);
  const std::uint32_t difference = binary(SeriesStep::difference, fixed, y);
  const std::uint32_t negation = binary(SeriesStep::negation, sum, fixed);
  const std::uint32_t scaled = binary(SeriesStep::product, fixed, negation);
  const std::uint32_t product = binary(SeriesStep::product, scaled, difference);
  const std::uint32_t square = binary(SeriesStep::product, product, product);
  const std::uint32_t quotient = binary(SeriesStep::quotient, square, difference);
  const std::uint32_t chain = binary(SeriesStep::chain, x, quotient);
  const std::uint32_t inverse = binary(SeriesStep::inverse_chain, y, difference);
  const std::uint32_t root = binary(SeriesStep::root, chain, fixed);
  const std::uint32_t power = binary(SeriesStep::power, inverse, fixed);
  const std::uint32_t angle = binary(SeriesStep::angle, x, y, square);
  const std::uint32_t same = binary(SeriesStep::same, angle, fixed);
  const std::uint32_t zero = binary(SeriesStep::zero, fixed, fixed);
  const std::uint32_t total = binary(SeriesStep::sum, binary(SeriesStep::sum, root, power), same);
  tape.outputs = {{.node = binary(SeriesStep::sum, total, zero), .moves = true},
                  {.node = chain, .moves = true}};
  return tape;
}

/// The memory of series of a tape.
struct Series {
  explicit Series(const Tape& tape)
      : coefficients(tape.size * (kOrders + 1)),
        weighted(coefficients.size()),
        states(tape.outputs.size() * (kOrders + 1)),
        last_nonzero(2 * tape.size) {
    memory.nodes = tape.nodes.data();
    memory.node_count = tape.nodes.size();
    memory.outputs = tape.outputs.data();
    memory.state_count = tape.outputs.size();
    memory.stride = kOrders + 1;
    memory.tape_size = tape.size;
  }

  void run(const TaylorKernels& kernels, std::size_t lanes) {
    memory.coefficients = coefficients.data();
    memory.weighted = weighted.data();
    memory.states = states.data();
    memory.last_nonzero = last_nonzero.data();
    memory.lanes = lanes;
    for (std::size_t k = 0; k < kOrders; ++k) kernels.extend(memory, k);
    BallLanes step;
    for (std::size_t lane = 0; lane < BallLanes::kLanes; ++lane) step.middle[lane] = 0.25;
    for (std::size_t i = 0; i < sums.size(); ++i) kernels.polynomial(memory, i, kOrders, step, sums[i]);
  }

  std::vector<BallLanes> coefficients, weighted, states;
  std::vector<std::uint32_t> last_nonzero;
  std::vector<BallLanes> sums{2};
  SeriesMemory memory;
};

/// Order 0 of all nodes and states in all lanes.
Series random_series(const Tape& tape, RandomDoubles& random) {
  Series series(tape);
  const auto fill = [&](BallLanes& balls) {
    for (std::size_t lane = 0; lane < BallLanes::kLanes; ++lane) {
      const int kind = random.integer(0, 9);
      balls.middle[lane] = kind == 0 ? 0.0 : kind == 1 ? random.any() : random.uniform(-3.0, 3.0);
      balls.radius[lane] = random.integer(0, 2) == 0 ? 0.0 : random.uniform(0.0, 0.01);
    }
  };
  for (std::size_t i = 0; i < tape.size; ++i) fill(series.coefficients[i * (kOrders + 1)]);
  for (std::size_t i = 0; i < tape.outputs.size(); ++i) fill(series.states[i * (kOrders + 1)]);
  return series;
}

bool same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b);
}
bool same_lane(const BallLanes& a, const BallLanes& b, std::size_t lane, std::size_t lane_of_b) {
  return same(a.middle[lane], b.middle[lane_of_b]) && same(a.radius[lane], b.radius[lane_of_b]);
}

TEST(TaylorKernels, AreTheSameForEveryWidth) {
  RandomDoubles random(1);
  const Tape tape = some_tape();
  for (int run = 0; run < 300; ++run) {
    Series portable = random_series(tape, random);
    Series fastest = portable;
    portable.run(portable_taylor_kernels(), BallLanes::kLanes);
    fastest.run(taylor_kernels(), BallLanes::kLanes);
    for (std::size_t lane = 0; lane < BallLanes::kLanes; ++lane) {
      for (std::size_t c = 0; c < portable.coefficients.size(); ++c)
        ASSERT_TRUE(same_lane(portable.coefficients[c], fastest.coefficients[c], lane, lane)) << c;
      for (std::size_t c = 0; c < portable.states.size(); ++c)
        ASSERT_TRUE(same_lane(portable.states[c], fastest.states[c], lane, lane)) << c;
      for (std::size_t i = 0; i < 2; ++i)
        ASSERT_TRUE(same_lane(portable.sums[i], fastest.sums[i], lane, lane)) << i;
    }
  }
}

TEST(TaylorKernels, EachLaneIsAsItWouldBeAlone) {
  RandomDoubles random(2);
  const Tape tape = some_tape();
  for (int run = 0; run < 300; ++run) {
    Series together = random_series(tape, random);
    const Series start = together;
    together.run(taylor_kernels(), BallLanes::kLanes);
    for (std::size_t lane = 0; lane < BallLanes::kLanes; ++lane) {
      Series alone = start;
      for (std::vector<BallLanes>* const all : {&alone.coefficients, &alone.states}) {
        for (BallLanes& balls : *all) {
          const Ball ball{balls.middle[lane], balls.radius[lane]};
          balls = {};
          balls.middle[0] = ball.middle;
          balls.radius[0] = ball.radius;
        }
      }
      alone.run(portable_taylor_kernels(), 1);
      for (std::size_t c = 0; c < alone.states.size(); ++c)
        ASSERT_TRUE(same_lane(together.states[c], alone.states[c], lane, 0)) << lane << ' ' << c;
      for (std::size_t i = 0; i < 2; ++i)
        ASSERT_TRUE(same_lane(together.sums[i], alone.sums[i], lane, 0)) << lane << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace coordreq
