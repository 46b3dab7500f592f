#include "spec/check_limits.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kMostStates = 31;
constexpr std::int64_t kMostValues = std::int64_t{1} << 20U;
constexpr std::size_t kMostAgentsOfAll = 7;

mpz_class power_of_two(unsigned exponent) {
  mpz_class value;
  mpz_ui_pow_ui(value.get_mpz_t(), 2, exponent);
  return value;
}

/// All digits, or the magnitude if they would fill the line.
std::string count_text(const mpz_class& count) {
  constexpr std::size_t kMostDigits = 40;
  const std::string digits = count.get_str();
  return digits.size() <= kMostDigits ? digits : fmt::format("about 10^{}", digits.size() - 1);
}

void refuse_above(const mpz_class& count, const mpz_class& limit, std::string_view what,
                  const std::string& pointer) {
  if (count <= limit) return;
  throw LimitError(fmt::format("{} {}, at most {} are possible", count_text(count), what, limit.get_str()),
                   pointer);
}

}  // namespace

void check_point_count(const mpz_class& count, const std::string& pointer) {
  refuse_above(count, power_of_two(31) - 2, "grid points", pointer);
}

void check_value_count(std::int64_t count, const std::string& pointer) {
  refuse_above(static_cast<long>(count), static_cast<long>(kMostValues), "values of one input", pointer);
}

void check_value_bits(const GridSpec& values, const std::string& pointer) {
  const auto bits = [](const Rational& q) {
    return mpz_sizeinbase(q.get_num_mpz_t(), 2) + mpz_sizeinbase(q.get_den_mpz_t(), 2);
  };
  const std::size_t most = bits(values.first) + bits(values.step);
  refuse_above(mpz_class(static_cast<long>(values.count)) * most, power_of_two(28),
               fmt::format("bits of {} values of one input", values.count), pointer);
}

void check_cell_count(const std::vector<StateSpec>& states) {
  refuse_above(states.size(), kMostStates, "states", "/states");
  mpz_class cells = 1;
  for (const StateSpec& state : states) cells *= static_cast<long>(state.grid.count);
  refuse_above(cells, power_of_two(62), "cells", "/states");
}

void check_joint_input_count(const std::vector<std::int64_t>& counts) {
  mpz_class joint = 1;
  for (const std::int64_t count : counts) joint *= static_cast<long>(count);
  refuse_above(joint, power_of_two(31), "joint inputs", "/inputs");
}

void check_mode_count(std::size_t count, std::size_t limit, const std::string& pointer) {
  refuse_above(count, limit, "modes", pointer);
}

void check_all_partitions(std::size_t agents, const std::string& pointer) {
  if (agents <= kMostAgentsOfAll) return;
  throw LimitError(fmt::format("'all' is possible for at most {} agents, which have 877 partitions, found {} "
                               "agents; expected a list of partitions",
                               kMostAgentsOfAll, agents),
                   pointer);
}

}  // namespace coordreq
