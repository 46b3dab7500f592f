// E_q: the greatest expectation of risks over what follows a mode.

#include "answers/risk/expected_risk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "answers/risk/risk_levels.hpp"
#include "spec/coordination_spec.hpp"

namespace coordreq {
namespace {

using Successor = ExpectedRisk::Successor;

Rational ratio(long numerator, long denominator) {
  return {numerator, denominator};
}

/// E of a mode with these successors, where the risk of the i-th is risks[i].
template <class Level>
RiskNumber<Level> expected(const std::vector<Successor>& successors, const std::vector<float>& risks) {
  std::vector<std::uint32_t> levels;
  for (const float risk : risks) levels.push_back(risk_level<std::uint32_t>(risk));
  std::vector<const std::uint32_t*> rows;
  for (const std::uint32_t& level : levels) rows.push_back(&level);
  Level out = 0;
  ExpectedRisk(successors).find<Level>(rows, 1, &out);
  return risk_of(out);
}

double in_double(const std::vector<Successor>& successors, const std::vector<float>& risks) {
  return expected<std::uint64_t>(successors, risks);
}
float in_float(const std::vector<Successor>& successors, const std::vector<float>& risks) {
  return expected<std::uint32_t>(successors, risks);
}

const std::vector<Successor> kHalves = {{0, ratio(1, 2), ratio(1, 2)}, {1, ratio(1, 2), ratio(1, 2)}};
const std::vector<Successor> kTenth = {{0, ratio(9, 10), ratio(9, 10)}, {1, ratio(1, 10), ratio(1, 10)}};

TEST(ExpectedRisk, ExactSumsStayExact) {
  EXPECT_EQ(in_float(kHalves, {0.5F, 0.25F}), 0.375F);
  EXPECT_EQ(in_double(kHalves, {0.5F, 0.25F}), 0.375);
}

TEST(ExpectedRisk, IsTheNextFloatAboveWhatIsNoFloat) {
  const float risk = in_float(kTenth, {0, 1});
  EXPECT_GE(exact(double{risk}), ratio(1, 10));
  EXPECT_LT(exact(double{std::nextafter(risk, 0.0F)}), ratio(1, 10));
}

TEST(ExpectedRisk, IsZeroOnlyWhereNothingIsAtRisk) {
  EXPECT_EQ(in_float(kTenth, {0, 0}), 0);
  const Rational tiny = ratio(1, 1) / (Rational("1" + std::string(300, '0')));
  const std::vector<Successor> rare = {{0, 1 - tiny, 1 - tiny}, {1, tiny, tiny}};
  EXPECT_GT(in_float(rare, {0, std::numeric_limits<float>::denorm_min()}), 0);
  EXPECT_GT(in_double(rare, {0, std::numeric_limits<float>::denorm_min()}), 0);
}

TEST(ExpectedRisk, NeverExceedsTheGreatestRisk) {
  const std::vector<Successor> thirds = {
      {0, ratio(1, 3), ratio(1, 3)}, {1, ratio(1, 3), ratio(1, 3)}, {2, ratio(1, 3), ratio(1, 3)}};
  EXPECT_EQ(in_double(thirds, {1, 1, 1}), 1);
  EXPECT_EQ(in_double(thirds, {0.1F, 0.1F, 0.1F}), double{0.1F});
  EXPECT_EQ(in_float(thirds, {0.1F, 0.1F, 0.1F}), 0.1F);
}

TEST(ExpectedRisk, WhatIsLeftOverGoesToTheGreatestRisksFirst) {
  const std::vector<Successor> ranges = {
      {0, ratio(1, 4), 1}, {1, 0, ratio(1, 4)}, {2, ratio(1, 8), ratio(3, 8)}};
  // 3/8 have no choice; of the other 5/8 the first may have all.
  EXPECT_EQ(in_double(ranges, {1, 0.5F, 0}), 0.25 + 0.625);
  // 1/4 is the most that the second may have, then 1/4 more for the third, and the rest for the first.
  EXPECT_EQ(in_double(ranges, {0, 1, 0.5F}), 0.25 + 0.5 * 0.375);
  EXPECT_EQ(in_float(ranges, {0, 1, 0.5F}), 0.4375F);
}

TEST(ExpectedRisk, EveryLaneOfARowHasItsOwn) {
  constexpr std::size_t kLanes = 1000;
  std::vector<std::uint32_t> first, second;
  for (std::size_t j = 0; j < kLanes; ++j) {
    first.push_back(risk_level<std::uint32_t>(static_cast<float>(j) / 1024));
    second.push_back(risk_level<std::uint32_t>(static_cast<float>(kLanes - j) / 1024));
  }
  const std::vector<Successor> ranges = {{0, ratio(1, 4), 1}, {1, 0, ratio(3, 4)}};
  const std::vector<const std::uint32_t*> rows = {first.data(), second.data()};
  std::vector<std::uint32_t> levels(kLanes);
  ExpectedRisk(ranges).find(rows, kLanes, levels.data());
  for (std::size_t j = 0; j < kLanes; ++j) {
    const auto a = static_cast<float>(j) / 1024, b = static_cast<float>(kLanes - j) / 1024;
    EXPECT_EQ(risk_of(levels[j]), std::max(a, (a + 3 * b) / 4)) << j;
  }
}

TEST(ExpectedRisk, ModesWithTheSameNumbersShareOne) {
  NetworkSpec network;
  network.modes.resize(3);
  network.transitions = {{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 0}, {2, 1}};
  const ProbabilityRange half{ratio(1, 2), ratio(1, 2)}, some{0, 1};
  network.probabilities = {half, half, some, some, half, half};
  const ExpectedRisks risks(network);
  EXPECT_EQ(risks.different.size(), 2U);
  EXPECT_EQ(risks.of_mode, (std::vector<std::size_t>{0, 1, 0}));
}

TEST(RiskLevels, OrderAsRisksDoTheOtherWayRound) {
  EXPECT_EQ(risk_level<std::uint32_t>(0), std::numeric_limits<std::uint32_t>::max());
  EXPECT_EQ(risk_of(std::numeric_limits<std::uint32_t>::max()), 0);
  EXPECT_EQ(risk_of(std::uint32_t{0}), 1) << "blocked";
  EXPECT_EQ(risk_of(std::uint64_t{0}), 1) << "blocked";
  EXPECT_LT(risk_level<std::uint32_t>(0.5F), risk_level<std::uint32_t>(0.25F));
  EXPECT_EQ(risk_of(risk_level<std::uint64_t>(0.3)), 0.3);
}

}  // namespace
}  // namespace coordreq
