#include "reach/attack.hpp"

#include <gtest/gtest.h>

namespace coordreq::test {
namespace {

/// True if the value lies in the raw range, cells taken as closed; modulo the count where periodic.
bool in_range(const GridDimension& dimension, IndexRange range, double value) {
  const double position = (value - dimension.first.get_d()) / dimension.step.get_d();
  const double slack = 1e-9;  // of the simulation
  for (int turn = dimension.periodic() ? -3 : 0; turn <= (dimension.periodic() ? 3 : 0); ++turn) {
    const double k = position + turn * static_cast<double>(dimension.count);
    if (range.first - 0.5 - slack <= k && k <= range.last + 0.5 + slack) return true;
  }
  return false;
}

}  // namespace

void attack(const SystemSpec& spec, const Abstraction& abstraction, int cases) {
  std::mt19937_64 random(20180410);
  for (int c = 0; c < cases; ++c) {
    const RandomStart start = random_start(spec, abstraction, random);
    const std::vector<double> next = simulate(spec, start.slots, random).back();
    for (std::size_t i = 0; i < abstraction.grid.size(); ++i) {
      ASSERT_TRUE(in_range(abstraction.grid[i], abstraction.raw(i, start.cell, start.input), next[i]))
          << abstraction.grid[i].name << " = " << next[i] << " from cell " << start.cell << " under input "
          << start.input;
    }
  }
}

}  // namespace coordreq::test
