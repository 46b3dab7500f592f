#pragma once

#include <random>
#include <string>
#include <vector>

#include "reach/build_abstraction.hpp"
#include "support/read_system.hpp"

namespace coordreq::test {

/// A spec with one input u in {-1, 0, 0.5} and the period 0.5.
[[nodiscard]] std::string spec_text(const std::string& states, const std::string& time,
                                    const std::string& equations, const std::string& abstraction = "{}");

[[nodiscard]] Abstraction build(const SystemSpec& spec);

/// Follows a solution with classical Runge-Kutta steps, far finer than the cells; in discrete time one step.
/// Disturbances switch a few times at random, to their ends more often than not. The equations see the
/// representatives of periodic states, the result is not wrapped.
/// @param slots states and inputs @returns the states after each step
[[nodiscard]] std::vector<std::vector<double>> simulate(const SystemSpec& spec, std::vector<double> slots,
                                                        std::mt19937_64& random);

/// A cell, a joint input, and a true state that can be measured in the cell: a corner one time in three.
struct RandomStart {
  std::int64_t cell = 0;
  std::int64_t input = 0;
  std::vector<double> slots;
};
[[nodiscard]] RandomStart random_start(const SystemSpec& spec, const Abstraction& a, std::mt19937_64& random);

}  // namespace coordreq::test
