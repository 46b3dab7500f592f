// Networks whose losses are drawn from their numbers.

#include "cell/lossy_network.hpp"

#include <gtest/gtest.h>

#include "spec/coordination_spec.hpp"

namespace coordreq {
namespace {

Rational ratio(long numerator, long denominator) {
  Rational result(numerator, denominator);
  result.canonicalize();
  return result;
}

using Numbers = std::vector<Rational>;

TEST(Likeliest, IsTheMiddleWhereThatSumsToOne) {
  EXPECT_EQ(likeliest({{0, ratio(1, 2)}, {ratio(1, 2), 1}}), (Numbers{ratio(1, 4), ratio(3, 4)}));
  EXPECT_EQ(likeliest({{ratio(1, 10), ratio(1, 10)}, {ratio(9, 10), ratio(9, 10)}}),
            (Numbers{ratio(1, 10), ratio(9, 10)}));
}

TEST(Likeliest, MovesAllByTheSameAsFarAsTheyGo) {
  // Middles of 1/4, 1/4 and 0 leave 1/2: the last stays, the others have room for as much.
  EXPECT_EQ(likeliest({{0, ratio(1, 2)}, {0, ratio(1, 2)}, {0, 0}}), (Numbers{ratio(1, 2), ratio(1, 2), 0}));
  // 1/8 and 3/8 leave 1/2; the first goes no farther than 1/4.
  EXPECT_EQ(likeliest({{0, ratio(1, 4)}, {0, ratio(3, 4)}}), (Numbers{ratio(1, 4), ratio(3, 4)}));
  // Too much is taken away likewise.
  EXPECT_EQ(likeliest({{ratio(1, 2), 1}, {0, 1}}), (Numbers{ratio(5, 8), ratio(3, 8)}));
}

NetworkSpec two_modes(const Rational& loss) {
  NetworkSpec network;
  network.modes.resize(2);
  network.modes[0].partition.classes = {{0, 1}};
  network.modes[1].partition.classes = {{0}, {1}};
  network.transitions = {{0, 0}, {0, 1}, {1, 0}};
  network.probabilities = {{1 - loss, 1 - loss}, {loss, loss}, {1, 1}};
  return network;
}

TEST(LossyNetwork, IsDrawnAsOftenAsItsNumbersSay) {
  const NetworkSpec spec = two_modes(ratio(1, 10));
  const LossyNetwork network(spec);
  EXPECT_TRUE(network.modes()[0].is_connected);
  EXPECT_FALSE(network.modes()[1].is_connected);
  RandomStream random(1, 0, RandomStream::Purpose::losses);
  int lost = 0;
  for (int k = 0; k < 100000; ++k) lost += network.draw(0, random) == 1 ? 1 : 0;
  EXPECT_NEAR(lost, 10000, 400);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(network.draw(1, random), 0U);
}

}  // namespace
}  // namespace coordreq
