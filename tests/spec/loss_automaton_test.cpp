#include "spec/loss_automaton.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

namespace coordreq {
namespace {

constexpr std::size_t kModes = 4096;
using Names = std::vector<std::string>;

/// The modes that a sequence of steps can be in, from the initial mode on, its own step not counted.
std::vector<std::size_t> run(const LossAutomaton& automaton, const std::string& steps) {
  std::vector<std::size_t> modes = {0};
  for (const char step : steps) {
    std::vector<std::size_t> next;
    for (const auto& [from, to] : automaton.transitions) {
      const auto target = static_cast<std::size_t>(to);
      const bool is_here = std::count(modes.begin(), modes.end(), static_cast<std::size_t>(from)) > 0;
      if (is_here && automaton.is_up(target) == (step == '1')) next.push_back(target);
    }
    modes = next;
  }
  return modes;
}

/// Compares the automaton with a rule on whole sequences that follow a past without losses, and looks for
/// two modes that nothing tells apart.
void expect_exactly(const LossAutomaton& automaton, const std::function<bool(const std::string&)>& allows,
                    std::size_t length) {
  std::set<std::size_t> seen = {0};
  for (std::size_t bits = 0; bits < (std::size_t{1} << length); ++bits) {
    std::string steps;
    for (std::size_t i = 0; i < length; ++i) steps += (bits >> i & 1U) != 0 ? '1' : '0';
    for (std::size_t n = 1; n <= length; ++n) {
      const std::vector<std::size_t> modes = run(automaton, steps.substr(0, n));
      EXPECT_LE(modes.size(), 1U);
      EXPECT_EQ(!modes.empty(), allows(steps.substr(0, n))) << steps.substr(0, n);
      if (modes.empty()) break;
      seen.insert(modes[0]);
    }
  }
  EXPECT_EQ(seen.size(), automaton.names.size());
}

/// Moore's partition of the modes by what can follow.
std::size_t distinguishable(const LossAutomaton& automaton) {
  std::vector<std::size_t> block;
  for (std::size_t mode = 0; mode < automaton.names.size(); ++mode)
    block.push_back(automaton.is_up(mode) ? 1 : 0);
  for (std::size_t count = 0;;) {
    std::vector<std::pair<std::size_t, std::set<std::size_t>>> signature(block.size());
    for (std::size_t mode = 0; mode < block.size(); ++mode) signature[mode].first = block[mode];
    for (const auto& [from, to] : automaton.transitions) {
      signature[static_cast<std::size_t>(from)].second.insert(block[static_cast<std::size_t>(to)]);
    }
    const std::set<std::pair<std::size_t, std::set<std::size_t>>> all(signature.begin(), signature.end());
    for (std::size_t mode = 0; mode < block.size(); ++mode) {
      block[mode] = static_cast<std::size_t>(std::distance(all.begin(), all.find(signature[mode])));
    }
    if (all.size() == count) return count;
    count = all.size();
  }
}

TEST(LossAutomaton, ADelayIsAChain) {
  const LossAutomaton delay = delay_automaton(3, kModes).value();
  EXPECT_EQ(delay.names, (Names{"0", "00", "000", "1"}));
  EXPECT_EQ(delay.transitions,
            (std::vector<std::pair<std::int32_t, std::int32_t>>{{0, 1}, {1, 2}, {2, 3}, {3, 3}}));
  EXPECT_EQ(delay_automaton(0, kModes)->names, Names{"1"});
}

TEST(LossAutomaton, BurstsAreNamedByTheirHistory) {
  EXPECT_EQ(burst_automaton(3, 2, kModes)->names, (Names{"111", "110", "101", "100", "000"}));
  EXPECT_EQ(burst_automaton(1, 1, kModes)->names, (Names{"1", "0"}));
  EXPECT_EQ(burst_automaton(1, 3, kModes)->names, (Names{"111", "110", "101", "011"}));
}

TEST(LossAutomaton, BurstsAreThoseOfTheRule) {
  for (std::int64_t length = 1; length <= 4; ++length) {
    for (std::int64_t gap = 1; gap <= 4; ++gap) {
      const LossAutomaton automaton = burst_automaton(length, gap, kModes).value();
      EXPECT_EQ(automaton.names.size(), static_cast<std::size_t>(length + gap));
      EXPECT_EQ(distinguishable(automaton), automaton.names.size());
      expect_exactly(
          automaton,
          [&](const std::string& steps) {
            std::int64_t down = 0;
            std::int64_t up = gap;  // before the first step all was well
            for (const char step : steps) {
              if (step == '0' && down == 0 && up < gap) return false;
              down = step == '0' ? down + 1 : 0;
              up = step == '1' ? up + 1 : 0;
              if (down > length) return false;
            }
            return true;
          },
          9);
    }
  }
}

TEST(LossAutomaton, WeaklyHardModesAreNamedByTheirHistory) {
  EXPECT_EQ(weakly_hard_automaton(2, 5, kModes)->names,
            (Names{"1111", "1110", "1101", "1100", "1011", "1010", "1001", "0110", "0101", "0011"}));
  EXPECT_EQ(weakly_hard_automaton(1, 3, kModes)->names, (Names{"11", "10", "01"}));
  EXPECT_EQ(weakly_hard_automaton(0, 4, kModes)->names, Names{"1"});
  EXPECT_EQ(weakly_hard_automaton(4, 4, kModes)->names, (Names{"1", "0"}));
  EXPECT_EQ(weakly_hard_automaton(1, 1, kModes)->names, (Names{"1", "0"}));
  EXPECT_EQ(weakly_hard_automaton(2'000'000'000, 2'000'000'000, kModes)->names, (Names{"1", "0"}));
}

TEST(LossAutomaton, WeaklyHardSequencesAreThoseOfTheRule) {
  for (std::int64_t window = 1; window <= 6; ++window) {
    for (std::int64_t misses = 0; misses <= window; ++misses) {
      const LossAutomaton automaton = weakly_hard_automaton(misses, window, kModes).value();
      EXPECT_EQ(distinguishable(automaton), automaton.names.size());
      expect_exactly(
          automaton,
          [&](const std::string& steps) {
            for (std::size_t end = 1; end <= steps.size(); ++end) {
              const std::size_t begin = end - std::min(end, static_cast<std::size_t>(window));
              if (std::count(steps.begin() + static_cast<std::ptrdiff_t>(begin),
                             steps.begin() + static_cast<std::ptrdiff_t>(end), '0') > misses) {
                return false;
              }
            }
            return true;
          },
          10);
    }
  }
}

TEST(LossAutomaton, MoreThanTheMostModesIsNothing) {
  EXPECT_FALSE(delay_automaton(4, 4).has_value());
  EXPECT_TRUE(delay_automaton(3, 4).has_value());
  EXPECT_FALSE(burst_automaton(3, 2, 4).has_value());
  EXPECT_FALSE(weakly_hard_automaton(2, 5, 9).has_value());
  EXPECT_TRUE(weakly_hard_automaton(2, 5, 10).has_value());
}

}  // namespace
}  // namespace coordreq
