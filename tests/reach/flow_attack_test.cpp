#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "reach/random_flow.hpp"
#include "spec/system_spec.hpp"

namespace coordreq {
namespace {

constexpr int kSystems = 12;  ///< a case of RapidCheck
constexpr int kSolutions = 4;
constexpr int kSteps = 420;  ///< half of it is divisible by the number of pieces of nearly every signal

bool is_near(const Interval& range, long double value, long double tolerance) {
  const long double slack = tolerance * (1.0L + std::fabs(value));
  return range.lower - slack <= value && value <= range.upper + slack;
}

void log_case(const FlowCase& system) {
  for (const Program& equation : system.equations) RC_LOG(equation.text + "\n");
  for (std::size_t s = 0; s < system.slots.size(); ++s) {
    RC_LOG(std::string(kFlowNames[s]) + " in [" + std::to_string(system.slots[s].lower) + ", " +
           std::to_string(system.slots[s].upper) + "]\n");
  }
  RC_LOG("tau " + std::to_string(system.tau) + "\n");
}

/// No solution escapes from its enclosure. The reference counts as wrong by its change from half as many
/// steps, and by `tolerance` at least.
/// @returns whether there is an enclosure
bool attack_flow(const FlowCase& system, long double tolerance) {
  const FlowEnclosure enclosure = system.enclosure();
  if (enclosure.status != FlowEnclosure::Status::ok) return false;
  for (int k = 0; k < kSolutions; ++k) {
    const std::vector<long double> start = random_start(system);
    const Signal signal = random_signal(system);
    const auto path = integrate(system, start, signal, kSteps);
    const auto coarse = integrate(system, start, signal, kSteps / 2);
    for (std::size_t i = 0; i < enclosure.end.size(); ++i) {
      const long double error = tolerance + std::fabs(path.back()[i] - coarse.back()[i]);
      RC_ASSERT(enclosure.end[i].lower <= enclosure.end[i].upper);
      if (!is_near(enclosure.end[i], path.back()[i], error)) log_case(system);
      RC_ASSERT(is_near(enclosure.end[i], path.back()[i], error));
      for (const auto& states : path) {
        RC_ASSERT(is_near(enclosure.tube[i], states[i], error));
        RC_ASSERT(is_near(enclosure.drift[i], states[i] - path.front()[i], error));
      }
    }
  }
  return true;
}

/// @param make_case draws a case
template <class MakeCase>
void attack_many(MakeCase make_case, long double tolerance) {
  int enclosed = 0;
  for (int n = 0; n < kSystems; ++n) enclosed += attack_flow(make_case(), tolerance) ? 1 : 0;
  RC_CLASSIFY(enclosed >= kSystems - 2, "nearly all systems enclosed");
}

TEST(FlowAttack, SmoothSystemsStayInTheirEnclosures) {
  EXPECT_TRUE(rc::check([] { attack_many([] { return random_case(Roughness::smooth); }, 1e-13L); }));
}

TEST(FlowAttack, SystemsWithKinksStayInTheirEnclosures) {
  EXPECT_TRUE(rc::check([] { attack_many([] { return random_case(Roughness::lipschitz); }, 1e-8L); }));
}

TEST(FlowAttack, SystemsWithJumpsStayInTheirEnclosures) {
  // The reference may jump a step late, and then be off by a step's way.
  EXPECT_TRUE(rc::check([] { attack_many([] { return random_case(Roughness::discontinuous); }, 0.02L); }));
}

/// Limits at a side of the box, in its middle or a little beyond it.
FlowCase random_stopped_case() {
  FlowCase system = random_case(Roughness::smooth);
  for (std::size_t i = 0; i < system.equations.size(); ++i) {
    const Interval& box = system.slots[i];
    const double lower = pick(2) == 0 ? box.lower : 0.5 * box.lower + 0.5 * box.upper;
    const double upper = pick(2) == 0 ? box.upper : box.upper + 0.05;
    system.stops.push_back({pick(2) == 0, pick(2) == 0, {lower, lower}, {upper, upper}});
  }
  return system;
}

TEST(FlowAttack, StoppedStatesStayInTheirEnclosures) {
  EXPECT_TRUE(rc::check([] { attack_many(random_stopped_case, 2e-3L); }));
}

}  // namespace
}  // namespace coordreq
